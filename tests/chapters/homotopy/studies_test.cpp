/// Basis of the chapter's figures and tables.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "chapters/drawing.hpp"
#include "chapters/homotopy/solvers/counted.hpp"
#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/frames/toggle.hpp"

namespace nlmech::chapters::homotopy::studies_test {
namespace {

// oracle: homotopy_williams Williams 0.44 maximum, Williams 0.44 minimum
// oracle: homotopy_frames toggle 0.44 of 1 maximum, toggle 0.44 of 1 minimum
TEST(LoadCurves, LimitPoints) {
  EXPECT_FALSE(limit_points(*williams_curve(0.32)));
  EXPECT_FALSE(limit_points(*element_curve(0.32)));
  const auto w = limit_points(*williams_curve(0.44)), e = limit_points(*element_curve(0.44));
  ASSERT_TRUE(w && e);
  EXPECT_NEAR(w->maximum.load, 42.771896097273, 1e-11);
  EXPECT_NEAR(w->minimum.load, 30.363548710287, 1e-11);
  EXPECT_NEAR(e->maximum.load, 42.435492120383, 1e-11);
  EXPECT_NEAR(e->minimum.load, 32.124218754757, 1e-11);
}

// dW/ddelta against central differences of W: h^2 W'''/6 and rounding of W over h.
RC_GTEST_PROP(LoadCurves, StiffnessIsTheSlope, ()) {
  const double d = *rc::gen::inRange(0, 900) * 1e-3, height = *rc::gen::element(0.32, 0.38, 0.44), h = 1e-4;
  for (const bool williams : {true, false}) {
    const auto curve = williams ? williams_curve(height) : element_curve(height);
    const double difference = (curve->load(d + h) - curve->load(d - h)) / (2 * h);
    RC_ASSERT(std::abs(curve->stiffness(d) - difference) < 1e-4 + 1e-6 * std::abs(difference));
  }
}

TEST(LoadCurves, EquilibriaCarryTheLoad) {
  const auto curve = element_curve(0.44);
  for (const double load : {10.0, 35.0, 42.0, 60.0}) {
    const auto all = deflections_under(*curve, load);
    EXPECT_EQ(all.size(), load > 32.2 && load < 42.4 ? 3U : 1U) << load;
    for (const double d : all) EXPECT_NEAR(curve->load(d), load, 1e-11) << load;
  }
}

// At rest the residual is half the load for every model; the unknowns include the deflection.
TEST(LoadedToggles, AgreeWithTheCurves) {
  for (const Model model :
       {Model::williams, Model::williams_frozen, Model::element, Model::element_printed}) {
    LoadedToggle toggle(model, 0.44, near_load);
    const bool williams = model == Model::williams || model == Model::williams_frozen;
    const auto curve = williams ? williams_curve(0.44) : element_curve(0.44);
    for (const double d : {0.0, 0.1, 0.5}) {
      Eigen::VectorXd f(1);
      toggle.equations().residual(toggle.unknowns(d), f);
      EXPECT_NEAR(std::abs(f[0]), std::abs(curve->load(d) - near_load) / 2, 1e-12);
      EXPECT_EQ(toggle.deflection(toggle.unknowns(d)), d);
    }
    EXPECT_EQ(toggle.scale(), near_load / 2);
  }
}

// d_5 held constant: the slope of Eq. 2.21 between two deflections, with d_5 of the first in both.
TEST(LoadedToggles, FrozenJacobianHoldsD5) {
  LoadedToggle toggle(Model::williams_frozen, 0.44, near_load);
  const frames::Williams w{.height = 0.44};
  for (const double d : {0.05, 0.2, 0.6}) {
    const double n = -w.compression(d) * w.length * w.length / w.ei;
    const double six_d5 = frames::stability_functions<double>(n).antisymmetric.value + n;
    const auto half_load = [&](double x) {
      return w.ei * six_d5 / std::pow(w.length, 3) * x + w.compression(x) * w.height / w.length;
    };
    Eigen::MatrixXd b;
    toggle.equations().linearise(toggle.unknowns(d));
    toggle.equations().matrix(b);
    // A quadratic: its central difference is exact.
    EXPECT_NEAR(b(0, 0), (half_load(d + 0.1) - half_load(d - 0.1)) / 0.2, 1e-9);
  }
}

// A step of 2 makes Eq. 2.16 Newton's iteration for one unknown.
TEST(Iterations, StepOfTwoIsNewton) {
  LoadedToggle toggle(Model::williams, 0.32, low_load);
  std::vector<IterationRecord> newton, homotopy;
  EXPECT_TRUE(iterate(toggle, {}, &newton).converged);
  EXPECT_TRUE(iterate(toggle, {.scheme = Scheme::newton_homotopy, .step = 2}, &homotopy).converged);
  ASSERT_EQ(newton.size(), homotopy.size());
  for (std::size_t k = 0; k < newton.size(); ++k)
    EXPECT_NEAR(newton[k].deflection, homotopy[k].deflection, 1e-13) << k;
}

// Near the root a step dt leaves |1 - dt/2| of the residual.
TEST(Iterations, ContractionIsThatOfDampedNewton) {
  for (const double step : {0.3, 0.895, 1.5}) {
    LoadedToggle toggle(Model::williams, 0.32, low_load);
    std::vector<IterationRecord> trace;
    EXPECT_TRUE(
        iterate(toggle, {.scheme = Scheme::fixed_point, .step = step, .tolerance = 1e-9}, &trace).converged);
    const double ratio = trace.back().residual / trace.at(trace.size() - 2).residual;
    EXPECT_NEAR(ratio, 1 - step / 2, 1e-4) << step;
  }
}

TEST(Iterations, CountAndTraceAgree) {
  LoadedToggle toggle(Model::element_printed, 0.44, last_load);
  for (const Scheme scheme : {Scheme::newton, Scheme::fixed_point, Scheme::newton_homotopy}) {
    std::vector<IterationRecord> trace;
    const Count count =
        iterate(toggle, {.scheme = scheme, .step = 0.895, .tolerance = 0.022, .limit = 37}, &trace);
    EXPECT_EQ(trace.size(), static_cast<std::size_t>(count.iterations) + 1);
    EXPECT_EQ(trace.back().residual, count.residual);
    EXPECT_EQ(count.converged, count.residual <= 0.022);
    EXPECT_EQ(trace.front().deflection, 0);
  }
}

// The attractor of Table 2.5: 0.30373 of the load, printed 0.3042, reached from rest without free parameters.
TEST(Iterations, CycleOfTheMisprint) {
  LoadedToggle toggle(Model::element_printed, 0.44, last_load);
  const Count count = iterate(toggle, {.tolerance = relative_tolerance(last_load, 1e-3)});
  EXPECT_FALSE(count.converged);
  EXPECT_EQ(count.iterations, 1000);
  EXPECT_NEAR(count.residual / toggle.scale(), 0.30373, 1e-5);
  EXPECT_NEAR(count.residual / toggle.scale(), 0.3042, 0.005 * 0.3042);
}

TEST(Iterations, RowsAreThoseOfTheTables) {
  const auto rows = printed_rows();
  ASSERT_EQ(rows.size(), 10U);
  for (const PrintedRow& row : rows) {
    EXPECT_EQ(row.model == Model::williams, row.table < "table-2.4") << row.table;
    EXPECT_EQ(row.height, row.table == "table-2.2" ? 0.32 : 0.44);
  }
}

// Four operations on a variable are counted, operations on constants are not.
TEST(Counted, CountsWhatAVariableTakesPartIn) {
  std::int64_t operations = 0;
  const Counted x(4., &operations), y = 3 * x + sqrt(x) - 1;
  EXPECT_EQ(y.value, 13);
  EXPECT_EQ(operations, 4);
  EXPECT_EQ((Counted(2) * Counted(3)).value, 6);
  EXPECT_EQ(abs(-y).value, 13);
  EXPECT_EQ(operations, 4);
}

// Values of Counted are those of double, up to the rounding of a pole that double represents more accurately.
TEST(Counted, TangentIsThatOfDouble) {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44, .elements = 4});
  const Eigen::Index n = toggle.frame.size();
  EXPECT_EQ(n, 10);
  std::int64_t operations = 0;
  Eigen::VectorXd x(n);
  Eigen::Matrix<Counted, Eigen::Dynamic, 1> at(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = 1e-3 * std::cos(static_cast<double>(i));
    at[i] = {x[i], &operations};
  }
  Eigen::SparseMatrix<double> expected;
  Eigen::SparseMatrix<Counted> found;
  ASSERT_TRUE(toggle.frame.tangent<double>(x, expected).ok());
  ASSERT_TRUE(toggle.frame.tangent<Counted>(at, found).ok());
  ASSERT_EQ(found.nonZeros(), expected.nonZeros());
  const double largest = Eigen::MatrixXd(expected).cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < expected.nonZeros(); ++k)
    EXPECT_NEAR(found.valuePtr()[k].value, expected.valuePtr()[k], 1e-13 * largest);
}

}  // namespace
}  // namespace nlmech::chapters::homotopy::studies_test
