#include "nlmech/comparison/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace nlmech::comparison {

std::string quoted_cell(std::string_view text) {
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

Rows::Rows(const Request& request, const std::vector<std::string>& names)
    : request_(request),
      text_(fmt::format("t,{}{}\n", fmt::join(names, ","), request.events.empty() ? "" : ",event")) {
  if (request.every) {
    const double rows = std::abs(request.t1 - request.t0) / *request.every;
    stride_ = 1 + static_cast<std::int64_t>(rows / most_verified);
  }
}

void Rows::print(double t, const double* x, std::size_t size, const std::string& event) {
  auto out = std::back_inserter(text_);
  fmt::format_to(out, "{:.17g}", t);
  for (std::size_t i = 0; i < size; ++i) fmt::format_to(out, ",{:.17g}", x[i]);
  const bool plain = event.find_first_of(",\"\n\r") == std::string::npos;
  if (!request_.events.empty()) fmt::format_to(out, ",{}", plain ? event : quoted_cell(event));
  text_ += '\n';
}

void Rows::add(double t, const double* x, std::size_t size) {
  if (!request_.section) print(t, x, size, "");
  keep(t, x, size);
}

void Rows::keep(double t, const double* x, std::size_t size) {
  const Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(x, static_cast<Eigen::Index>(size));
  if (added_ > 1 && (added_ - 1) % stride_ != 0) kept_.pop_back();
  kept_.push_back({t, state});
  ++added_;
}

Verified Rows::verified(const Tolerance& tolerance) const {
  // The first row is the initial state.
  std::vector<Kept> all(std::next(kept_.begin()), kept_.end());
  const double way = request_.t1 - request_.t0, near = 1e-6 * std::abs(way);
  const std::size_t rows = all.size();
  const Eigen::VectorXd unasked =
      Eigen::VectorXd::Constant(kept_.front().x.size(), std::numeric_limits<double>::quiet_NaN());
  for (const double t : look_at(request_.t0, request_.t1, 16)) {
    const auto close = [&](const Kept& k) { return std::abs(k.t - t) <= near; };
    if (std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rows), close))
      all.push_back({t, unasked});
  }
  std::sort(all.begin(), all.end(),
            [way](const Kept& a, const Kept& b) { return way > 0 ? a.t < b.t : a.t > b.t; });
  Verified run{{}, Eigen::MatrixXd(unasked.size(), static_cast<Eigen::Index>(all.size())), tolerance};
  for (const Kept& k : all) {
    run.states.col(static_cast<Eigen::Index>(run.times.size())) = k.x;
    run.times.push_back(k.t);
  }
  return run;
}

}  // namespace nlmech::comparison
