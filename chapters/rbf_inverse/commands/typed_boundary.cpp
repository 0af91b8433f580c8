#include "chapters/rbf_inverse/commands/typed_boundary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/switches.hpp"
#include "nlmech/program/time_features.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using program::Program;
using scene::trimmed;

/// Splits a text at commas and semicolons outside parentheses.
std::vector<std::string> pieces_of(const char* option, const std::string& text) {
  std::vector<std::string> pieces(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    if (depth == 0 && (c == ',' || c == ';'))
      pieces.emplace_back();
    else
      pieces.back() += c;
  }
  for (std::string& piece : pieces) {
    piece = trimmed(piece);
    if (piece.empty())
      throw input_error("{} {}: an empty condition between two commas", option, quoted_input(text));
  }
  return pieces;
}

/// Derivatives of all outputs with respect to the state, four at a time; calls put(output, component, value).
template <class Put>
void differentiate(const Program& program, double t, const Eigen::VectorXd& x, const Put& put) {
  constexpr int lanes = 4;
  using D = Dual<double, lanes>;
  const int n = static_cast<int>(x.size());
  Vector<D, Eigen::Dynamic> at(n);
  for (int first = 0; first < n; first += lanes) {
    for (int i = 0; i < n; ++i) {
      const int lane = i - first;
      at[i] = lane >= 0 && lane < lanes ? D::variable(x[i], lane) : D(x[i]);
    }
    program.run(D(t), at, 0, program.outputs(), [&](int output, const D& value) {
      for (int lane = 0; lane < std::min(lanes, n - first); ++lane)
        put(output, first + lane, value.partial[static_cast<std::size_t>(lane)]);
    });
  }
}

/// Value and derivative of a function of time.
Dual<double, 1> value_of_time(const Program& program, double t, const Eigen::VectorXd& x) {
  using D = Dual<double, 1>;
  const Vector<D, Eigen::Dynamic> at = x.cast<D>();
  D value;
  program.run(D::variable(t, 0), at, 0, 1, [&](int, const D& v) { value = v; });
  return value;
}

/// Whether the program depends on the state: a NaN state then yields NaN.
bool depends_on_state(const Program& program, double t, int n) {
  const auto plain = [&](double x) {
    double value = 0;
    program.run(t, Eigen::VectorXd(Eigen::VectorXd::Constant(n, x)), 0, 1, [&](int, double v) { value = v; });
    return value;
  };
  return std::isnan(plain(std::numeric_limits<double>::quiet_NaN())) && !std::isnan(plain(0.5));
}

}  // namespace

TypedBoundary::TypedBoundary(program::Equations equations, double from, double until,
                             const std::string& begin, const std::string& end)
    : equations_(std::move(equations)), points_{from, until} {
  if (equations_.initial_time())
    throw InputError("--equation: give values at a time, such as x(0) = 1, by --begin and --end");
  if (equations_.final_time() || !equations_.lower_bounds().empty() || !equations_.conserved().empty())
    throw InputError(
        "--equation: end, bounds and conserved quantities are for initial value problems; give the end by "
        "--until");
  slopes_ = Program(equations_.graph(), equations_.slopes());
  constexpr std::size_t most_jumps = 200;  // each jump adds one condition per component
  const std::vector<double> jumps =
      program::Switches(equations_.graph(), equations_.slopes()).times(from, until);
  if (jumps.size() <= most_jumps) points_.insert(points_.begin() + 1, jumps.begin(), jumps.end());
  begin_ = conditions_of("--begin", begin);
  end_ = conditions_of("--end", end);
  const std::size_t given = begin_.outputs() + end_.outputs(), needed = names().size();
  if (given != needed)
    throw input_error(
        "--begin, --end: {} conditions, but the state has {} components, {}; give one condition for each",
        given, needed, quoted_input(fmt::format("{}", fmt::join(names(), ", ")), 200));
}

Program TypedBoundary::conditions_of(const char* option, const std::string& text) {
  std::vector<program::NodeId> all;
  if (!trimmed(text).empty()) {
    for (const std::string& piece : pieces_of(option, text)) {
      if (piece.find('=') == std::string::npos)
        throw input_error("{} {}: is no condition; give an equation, such as x = 0", option,
                          quoted_input(piece));
      all.push_back(equations_.expression(option, piece));
    }
  }
  return {equations_.graph(), all};
}

std::vector<double> TypedBoundary::mesh() const {
  std::vector<double> mesh =
      program::TimeFeatures(equations_.graph(), equations_.slopes()).between(points_.front(), points_.back());
  if (mesh.empty()) return mesh;
  constexpr int intervals = 10;  // additional equal intervals
  for (int k = 0; k <= intervals; ++k)
    mesh.push_back(points_.front() + (points_.back() - points_.front()) * k / intervals);
  std::ranges::sort(mesh);
  return mesh;
}

bvp::Start TypedBoundary::guess(const std::string& text) const {
  const int n = states();
  program::Equations equations = equations_;
  auto known = std::make_shared<std::vector<std::optional<Program>>>(names().size());
  if (!trimmed(text).empty()) {
    for (const std::string& piece : pieces_of("--guess", text)) {
      const std::size_t equals = piece.find('=');
      const auto at = std::ranges::find(names(), trimmed(piece.substr(0, equals)));
      if (equals == std::string::npos || at == names().end())
        throw input_error("--guess {}: must begin with a component and =; the components are {}",
                          quoted_input(piece),
                          quoted_input(fmt::format("{}", fmt::join(names(), ", ")), 200));
      std::optional<Program>& one = (*known)[static_cast<std::size_t>(at - names().begin())];
      if (one) throw input_error("--guess {}: {} is given twice", quoted_input(piece), *at);
      const program::NodeId node = equations.expression("--guess", piece.substr(equals + 1));
      one = Program(equations.graph(), {node});
      if (depends_on_state(*one, points_.front(), n))
        throw input_error("--guess {}: must be a function of the time t only", quoted_input(piece));
    }
  }
  // For each missing component the given component of which it is the derivative.
  std::vector<std::optional<std::size_t>> integral(names().size());
  for (std::size_t i = 0; i < names().size(); ++i) {
    for (std::size_t j = 0; j < names().size(); ++j) {
      if ((*known)[j] && names()[j] + "'" == names()[i]) integral[i] = j;
    }
  }
  return {[known, integral](double t, Eigen::VectorXd& x) {
            const Eigen::VectorXd zero = Eigen::VectorXd::Zero(x.size());
            for (std::size_t i = 0; i < known->size(); ++i) {
              double& value = x[static_cast<Eigen::Index>(i)];
              value = (*known)[i]   ? value_of_time(*(*known)[i], t, zero).value
                      : integral[i] ? value_of_time(*(*known)[*integral[i]], t, zero).partial[0]
                                    : 0;
            }
          },
          {},
          {}};
}

void TypedBoundary::rhs(double t, const Eigen::VectorXd& x, const Eigen::VectorXd&,
                        Eigen::VectorXd& dxdt) const {
  slopes_.run(t, x, 0, slopes_.outputs(), [&](int i, double value) { dxdt[i] = value; });
}

void TypedBoundary::jacobian(double t, const Eigen::VectorXd& x, const Eigen::VectorXd&,
                             Eigen::MatrixXd& by_state, Eigen::MatrixXd&) const {
  differentiate(slopes_, t, x, [&](int i, int j, double value) { by_state(i, j) = value; });
}

// Conditions of the user, then continuity of each component at each interior point.
void TypedBoundary::conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd&,
                               Eigen::VectorXd& r) const {
  const int n = states(), last = static_cast<int>(ends.cols()) - 1;
  const auto first = static_cast<int>(begin_.outputs());
  begin_.run(points_.front(), Eigen::VectorXd(ends.col(0)), 0, begin_.outputs(),
             [&](int i, double value) { r[i] = value; });
  end_.run(points_.back(), Eigen::VectorXd(ends.col(last)), 0, end_.outputs(),
           [&](int i, double value) { r[first + i] = value; });
  for (int k = 1; k < last; k += 2) r.segment(n * (k + 1) / 2, n) = ends.col(k) - ends.col(k + 1);
}

void TypedBoundary::condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd&,
                                       Eigen::MatrixXd& by_ends, Eigen::MatrixXd&) const {
  const int n = states(), last = static_cast<int>(ends.cols()) - 1;
  const auto first = static_cast<int>(begin_.outputs());
  by_ends.setZero();
  differentiate(begin_, points_.front(), ends.col(0),
                [&](int i, int j, double value) { by_ends(i, j) = value; });
  differentiate(end_, points_.back(), ends.col(last),
                [&](int i, int j, double value) { by_ends(first + i, last * n + j) = value; });
  for (Eigen::Index k = 1; k < last; k += 2) {
    auto rows = by_ends.middleRows(n * (k + 1) / 2, n);
    rows.middleCols(k * n, n).setIdentity();
    rows.middleCols((k + 1) * n, n) = -Eigen::MatrixXd::Identity(n, n);
  }
}

}  // namespace nlmech::chapters::rbf_inverse
