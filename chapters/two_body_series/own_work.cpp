#include "chapters/two_body_series/chapter.hpp"

namespace nlmech::chapters {

void two_body_series_work(CLI::App& /*app*/) {}

}  // namespace nlmech::chapters
