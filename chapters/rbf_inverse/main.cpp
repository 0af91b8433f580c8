#include "chapters/rbf_inverse/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::rbf_inverse_chapter(),
                                     nlmech::chapters::rbf_inverse_work, argc, argv);
}
