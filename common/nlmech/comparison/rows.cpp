#include "nlmech/comparison/rows.hpp"

#include <fmt/format.h>

#include <iterator>

namespace nlmech::comparison {

Rows::Rows(const Request& request, const std::vector<std::string>& names)
    : request_(request), text_(fmt::format("t,{}\n", fmt::join(names, ","))) {}

void Rows::add(double t, const double* x, std::size_t size) {
  auto out = std::back_inserter(text_);
  fmt::format_to(out, "{:.17g}", t);
  for (std::size_t i = 0; i < size; ++i) fmt::format_to(out, ",{:.17g}", x[i]);
  text_ += '\n';
}

}  // namespace nlmech::comparison
