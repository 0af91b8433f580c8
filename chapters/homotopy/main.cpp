#include "chapters/homotopy/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::homotopy_chapter(), nlmech::chapters::homotopy_work,
                                     argc, argv);
}
