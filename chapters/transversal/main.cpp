#include "chapters/transversal/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::transversal_chapter(),
                                     nlmech::chapters::transversal_work, argc, argv);
}
