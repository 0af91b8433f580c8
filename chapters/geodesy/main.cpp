#include "chapters/geodesy/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::geodesy_chapter(), nlmech::chapters::geodesy_work,
                                     argc, argv);
}
