#include "chapters/two_body_series/chapter.hpp"
#include "nlmech/scene/command_line.hpp"

int main(int argc, char** argv) {
  return nlmech::scene::chapter_main(nlmech::chapters::two_body_series_chapter(),
                                     nlmech::chapters::two_body_series_work, argc, argv);
}
