#include "chapters/hermitian/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::hermitian_chapter(), nlmech::chapters::hermitian_work,
                                     argc, argv);
}
