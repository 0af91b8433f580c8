#include "chapters/rbf_ivp/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::rbf_ivp::rbf_ivp_chapter(),
                                     nlmech::chapters::rbf_ivp::rbf_ivp_work, argc, argv);
}
