#include "chapters/gss_control/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::gss_control_chapter(),
                                     nlmech::chapters::gss_control_work, argc, argv);
}
