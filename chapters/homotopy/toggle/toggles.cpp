#include "chapters/homotopy/toggle/toggles.hpp"

#include <fmt/format.h>

#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {
namespace {

class WilliamsCurve : public LoadCurve {
 public:
  explicit WilliamsCurve(double height) : toggle_{.height = height} {}
  [[nodiscard]] double load(double d) const override { return toggle_.load(d); }
  [[nodiscard]] double stiffness(double d) const override { return toggle_.stiffness(d); }

 private:
  frames::Williams toggle_;
};

class ElementCurve : public LoadCurve {
 public:
  explicit ElementCurve(double height) : toggle_(make_frame(frames::Toggle{.height = height})) {}
  [[nodiscard]] double load(double d) const override {
    Eigen::VectorXd f;
    const Status status = toggle_.frame.force<double>(Eigen::VectorXd::Constant(1, -d), f);
    return status.ok() ? f[0] / toggle_.load[0] : std::nan("");
  }
  [[nodiscard]] double stiffness(double d) const override {
    Eigen::SparseMatrix<double> k;
    const Status status = toggle_.frame.tangent<double>(Eigen::VectorXd::Constant(1, -d), k);
    return status.ok() ? -k.coeff(0, 0) / toggle_.load[0] : std::nan("");
  }

 private:
  frames::ToggleFrame toggle_;
};

/// Root of a function by bisection to the last bit; the signs at @p low and @p high must differ.
template <class F>
double bisect(const F& f, double low, double high) {
  const bool sign = f(low) > 0;
  for (;;) {
    const double middle = (low + high) / 2;
    if (!(middle > low && middle < high)) return middle;
    ((f(middle) > 0) == sign ? low : high) = middle;
  }
}

/// Roots in [0, end] by bisection at the sign changes between 901 equidistant points.
template <class F>
std::vector<double> roots(const F& f, double end) {
  constexpr int places = 900;
  std::vector<double> found;
  for (int i = 0; i < places; ++i) {
    const double a = end * i / places, b = end * (i + 1) / places;
    if ((f(a) > 0) != (f(b) > 0)) found.push_back(bisect(f, a, b));
  }
  return found;
}

/// Eq. 2.21 with d_5 held constant in the derivative:
/// 6 EI d_5/l^3 + EA sin^2(beta)/l - 6 EA sin(beta) delta/(5 l^2).
double frozen_stiffness(const frames::Williams& w, double delta) {
  const double n = -w.compression(delta) * w.length * w.length / w.ei;
  const double six_d5 = frames::stability_functions<double>(n).antisymmetric.value + n;
  const double sine = w.height / w.length;
  return w.ei * six_d5 / (w.length * w.length * w.length) +
         w.ea / w.length * (sine * sine - 1.2 * sine * delta / w.length);
}

std::unique_ptr<algebraic::Equations> frozen_equations(const frames::Williams& w, double load) {
  const auto residual = [w, load](const Eigen::VectorXd& x, Eigen::VectorXd& f) {
    f[0] = w.outcome(x[0]) == Outcome::success ? (w.load(x[0]) - load) / 2 : std::nan("");
  };
  const auto derivative = [w](const Eigen::VectorXd& x, Eigen::MatrixXd& b) {
    b(0, 0) = w.outcome(x[0]) == Outcome::success ? frozen_stiffness(w, x[0]) : std::nan("");
  };
  return std::make_unique<algebraic::DenseEquations>(1, residual, derivative);
}

}  // namespace

std::unique_ptr<LoadCurve> williams_curve(double height) { return std::make_unique<WilliamsCurve>(height); }
std::unique_ptr<LoadCurve> element_curve(double height) { return std::make_unique<ElementCurve>(height); }

std::optional<LimitPoints> limit_points(const LoadCurve& curve, double end) {
  const auto found = roots([&](double d) { return curve.stiffness(d); }, end);
  if (found.size() < 2) return std::nullopt;
  return LimitPoints{{found[0], curve.load(found[0])}, {found[1], curve.load(found[1])}};
}

CurvePoint least_stiff_point(const LoadCurve& curve, double end) {
  // The stiffness has one minimum in the interval.
  const double d =
      boost::math::tools::brent_find_minima([&](double x) { return curve.stiffness(x); }, 0., end, 53).first;
  return {d, curve.load(d)};
}

std::vector<double> deflections_under(const LoadCurve& curve, double load, double end) {
  return roots([&](double d) { return curve.load(d) - load; }, end);
}

double deflection_between(const LoadCurve& curve, double load, double low, double high) {
  const auto excess = [&](double d) { return curve.load(d) - load; };
  if ((excess(low) > 0) == (excess(high) > 0)) return std::nan("");
  return bisect(excess, low, high);
}

algebraic::PathPoint first_limit_point(const frames::Toggle& toggle) {
  const frames::ToggleFrame t = make_frame(toggle);
  frames::LoadedFrame equations(t.frame, t.load);
  algebraic::Path path({.first = 2}, equations, Eigen::VectorXd::Zero(t.frame.size()), 0);
  Status status = path.start();
  algebraic::PathPoint fold;
  for (int k = 0; k < 100 && status.ok(); ++k) {
    status = path.advance();
    if (status.ok() && path.has_passed_fold() && path.fold(fold) == Outcome::success) return fold;
  }
  throw Failure(Status::failure(Outcome::not_converged, "the toggle has no limit point"));
}

LoadedToggle::LoadedToggle(Model model, double height, double load, double length)
    : sign_(1), scale_(std::abs(load) / 2) {
  const frames::Williams williams{.height = height, .length = length};
  if (model == Model::williams) {
    equations_ = std::make_unique<frames::WilliamsEquilibrium>(williams, load);
  } else if (model == Model::williams_frozen) {
    equations_ = frozen_equations(williams, load);
  } else {
    sign_ = -1;
    frame_ =
        std::make_unique<frames::ToggleFrame>(make_frame(frames::Toggle{.height = height, .length = length}));
    const auto coupling =
        model == Model::element ? frames::Coupling::consistent : frames::Coupling::as_printed;
    equations_ = std::make_unique<frames::Equilibrium>(frame_->frame, frame_->load, load, coupling);
  }
}

std::vector<double> deflections_to(double end) {
  constexpr int points = 300;
  std::vector<double> all;
  for (int i = 0; i <= points; ++i) all.push_back(end * i / points);
  return all;
}

void check_limit_points(const std::string& model, const LoadCurve& curve, const LimitPoints& reference,
                        scene::Show& show) {
  // The deflection is exact to rounding of the stiffness; the load is stationary there.
  constexpr double eleven_digits = 1e-11, nine_digits = 1e-9;
  const LimitPoints at = limit_points(curve).value_or(LimitPoints{{NAN, NAN}, {NAN, NAN}});
  const auto check = [&](const char* which, const CurvePoint& computed, const CurvePoint& expected) {
    show.near(fmt::format("load at the {}, {}", which, model), {computed.load, "lb"}, expected.load,
              eleven_digits, "tools/oracles/homotopy_williams.py and homotopy_frames.py, all digits");
    show.near(fmt::format("deflection at the {}, {}", which, model), {computed.deflection, "in"},
              expected.deflection, nine_digits,
              "as the load; the stiffness has a simple zero, rounding by 1e-12");
  };
  check("maximum", at.maximum, reference.maximum);
  check("minimum", at.minimum, reference.minimum);
}

}  // namespace nlmech::chapters::homotopy
