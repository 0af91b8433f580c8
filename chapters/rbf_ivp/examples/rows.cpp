#include "chapters/rbf_ivp/examples/rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "nlmech/scene/table.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using ivp::CentralDifference;
using ivp::Hht;
using ivp::Mcpi;
using ivp::Newmark;
using ivp::Ode45;
using ivp::RbfCollocation;
using ivp::Rk4;
using ivp::VelocityTime;

constexpr const char* found = "tools/oracles/rbf_ivp_methods.py, half a unit of its last digit";
constexpr const char* without_last =
    "tools/oracles/rbf_ivp_methods.py, without the last, shorter one of 1049 steps";
constexpr const char* end_twice =
    "tools/oracles/rbf_ivp_methods.py, with the end of the impact counted twice among 1009 points";

constexpr double digits = 5e-4, one_step = 1.5e-3;
constexpr double printed_period = 4.77;  // s, Table 4.1

}  // namespace

Expected about(double value, double relative, const char* reason) {
  return {value * (1 - relative), value * (1 + relative), reason};
}

Expected scattered(double low, double high) {
  constexpr double widened = 3;  // rounding depends on compiler and processor
  return {low / widened, high * widened,
          "regression value: the range over which results scattered when nodes were moved by roundings, "
          "widened by a factor of three on both sides"};
}

std::string Row::setting_text(const Case& c) const {
  const double end = inferred_end.value_or(c.inferred_end);
  std::string text = fmt::format("{}; RMS of the error of x1 {}", how,
                                 points == Points::ends ? "at the ends of steps" : "at all values");
  if (*missing == '\0')
    text += fmt::format("; nominal: {}to {:g} s", literal_procedure ? "P = 4.77, " : "", c.t1);
  if (*missing != '\0' || literal_procedure || end != c.t1 || inferred_component > 0 || inferred_procedure)
    text += fmt::format("; inferred: {}to {:.6g} s", literal_procedure ? "exact P, " : "", end);
  if (inferred_component > 0) text += fmt::format(", error of x{}", inferred_component + 1);
  if (inferred_procedure) text += ", " + how_inferred;
  return text;
}

Example free_duffing_rows() {
  // oracle: rbf_ivp_methods 4.2 * 500, 4.2 * 100 P, 4.2 * with P = 4.77
  const double P = duffing_period();
  Example all{.made = free_duffing_case,
              .name = "duffing",
              .title = "Free Duffing",
              .table = "table-4.2",
              .quantity = "position RMS error",
              .window = P};
  /// Adds a row of a method whose step size is a fraction of the period.
  const auto add = [&](Row row, const std::string& run, const std::string& how, auto method_of) {
    row.literal_procedure = throughout(method_of(printed_period));
    all.add(std::move(row), run, how, throughout(method_of(P)));
  };
  const auto add_ode45 = [&](Row row, const std::string& run, double tolerance) {
    all.add(std::move(row), run,
            fmt::format("relative and absolute tolerance {}, four values a step",
                        scene::format_number(tolerance, 1)),
            throughout(Ode45{tolerance, tolerance}));
  };
  const char *alpha = "alpha is not stated", *halved = "started with v(-h/2) = v0 - h/2 a0",
             *newmark = "beta = 1/4, gamma = 1/2, Newton to 1e-12",
             *hht = "alpha = -0.1 (not stated), the method of 1977 instead of Eq. 4.7 as printed";
  add_ode45({"ODE45-1", "ODE45-1", "tolerance 1e-6", Points::all, 0, about(1.302e-4, digits, found),
             about(1.175e-4, digits, found)},
            "ode45-1", 1e-6);
  add_ode45({"ODE45-2", "ODE45-2", "tolerance 1e-9", Points::all, 0, about(1.257e-6, digits, found),
             about(1.142e-6, digits, found)},
            "ode45-2", 1e-9);
  add({"Explicit-1 (P/10)", "Explicit-1", "P/10", Points::ends, 0, about(1.010, one_step, without_last),
       about(0.9935, digits, found), about(1.011, one_step, without_last)},
      "explicit-1", halved, [](double p) { return CentralDifference{.step = p / 10}; });
  add({"Explicit-2 (P/500)", "Explicit-2", "P/500", Points::ends, 0, about(1.612e-3, digits, found),
       about(1.535e-3, digits, found), about(1.613e-3, digits, found)},
      "explicit-2", halved, [](double p) { return CentralDifference{.step = p / 500}; });
  add({"RK4-1 (P/10)", "RK4-1", "P/10", Points::ends, 0, about(0.8674, one_step, without_last),
       about(0.8607, digits, found), about(0.8669, one_step, without_last)},
      "rk4-1", "classical method", [](double p) { return Rk4{p / 10}; });
  add({"RK4-2 (P/250)", "RK4-2", "P/250", Points::ends, 0, about(5.42e-6, 1e-3, found),
       about(5.008e-6, digits, found), about(5.432e-6, digits, found)},
      "rk4-2", "classical method", [](double p) { return Rk4{p / 250}; });
  add({"Newmark-1 (P/10)", "Newmark-1", "P/10", Points::ends, 0, about(0.9754, one_step, without_last),
       about(0.9977, digits, found), about(0.9749, one_step, without_last)},
      "newmark-1", newmark, [](double p) { return Newmark{p / 10}; });
  add({"Newmark-2 (P/500)", "Newmark-2", "P/500", Points::ends, 0, about(3.223e-3, digits, found),
       about(3.071e-3, digits, found), about(3.226e-3, digits, found)},
      "newmark-2", newmark, [](double p) { return Newmark{p / 500}; });
  add({.row = "HHT-1 (P/10)",
       .method = "HHT-1",
       .setting = "P/10",
       .nominal = about(0.8361, one_step, without_last),
       .inferred = about(0.8405, digits, found),
       .missing = alpha},
      "hht-1", hht, [](double p) { return Hht{p / 10}; });
  add({.row = "HHT-2 (P/500)",
       .method = "HHT-2",
       .setting = "P/500",
       .nominal = about(4.623e-3, digits, found),
       .inferred = about(4.378e-3, digits, found),
       .missing = alpha},
      "hht-2", hht, [](double p) { return Hht{p / 500}; });
  // To 100 P the errors are 1.97e-8 and 8.26e-8; the first row fits only the printed end.
  add({.row = "MCPI-1 (P/10)",
       .method = "MCPI-1",
       .setting = "P/10",
       .points = Points::all,
       .nominal = about(2.07e-8, 3e-3, found),
       .inferred = about(2.07e-8, 3e-3, found),
       .literal = about(5.31e-7, 5e-3, without_last),
       .inferred_end = 500},
      "mcpi-1", "order 8, 9 nodes, right-hand side to degree 7", [](double p) {
        return Mcpi{p / 10, 8};
      });
  const char* of_210 = "tools/oracles/rbf_ivp_methods.py, without the last, shorter one of 210 steps";
  add({.row = "MCPI-2 (P/2)",
       .method = "MCPI-2",
       .setting = "P/2",
       .points = Points::all,
       .nominal = about(8.64e-8, 0.01, of_210),
       .inferred = about(8.64e-8, 0.01, of_210),
       .literal = about(3.54e-7, 0.05, of_210),
       .inferred_end = 500},
      "mcpi-2", "order 16, 17 nodes, right-hand side to degree 15", [](double p) {
        return Mcpi{p / 2, 16};
      });
  add({"RBF-Coll-1 (P/10)", "RBF-Coll-1", "P/10", Points::ends, 0, scattered(2.1e-7, 4.2e-6), {}}, "rbf-1",
      "7 nodes, c = 0.77, derivative matrix by LU", [](double p) {
        return RbfCollocation{p / 10, 7, 0.77};
      });
  add({"RBF-Coll-2 (P)", "RBF-Coll-2", "P", Points::all, 0, scattered(2.6e-7, 3.8e-6), {}}, "rbf-2",
      "35 nodes, c = (N - 1)/(4 h), derivative matrix by LU", [](double p) {
        return RbfCollocation{p, 35};
      });
  return all;
}

Example impact_rows() {
  // The row of one shape, 0.33, is recorded. oracle: rbf_ivp_methods 4.4 RK* to *, 4.4 Newmark* to *, 4.4
  // HHT* to *, 4.4 MCPI* to *, 4.4 Explicit-* once, 4.4 Explicit-* fault *
  Example all{.made = impact_case,
              .name = "impact",
              .title = "Impact",
              .table = "table-4.4",
              .quantity = "position RMS error",
              .window = 5};
  const auto phases = [](auto method, double during, double after) {
    auto first = method, second = method;
    first.step = during;
    second.step = after;
    return in_two_phases(first, second);
  };
  const auto add = [&](Row row, const std::string& run, const std::string& how, const Procedure& procedure) {
    all.add(std::move(row), run, how + "; in two intervals", procedure);
  };
  const char* alpha = "alpha is not stated";
  const char *honest = "restarted with v(t_1)", *fault = "restarted with v(t_1 − h/2)";
  const auto faulty = [](double during, double after) {
    return in_two_phases(CentralDifference{.step = during, .reported = VelocityTime::half_step_before},
                         CentralDifference{.step = after, .initial = VelocityTime::half_step_before});
  };
  const auto add_explicit = [&](Row row, const std::string& run, double during, double after) {
    all.add(std::move(row), run, "restarted with v(t1 - h/2) = v(t1) - h/2 a(t1)",
            phases(CentralDifference{}, during, after),
            "restarted with v(t1 - h'/2) of the first step h' used as v(t1 - h/2) of the second step h",
            faulty(during, after));
  };
  add({"", "ODE45", "tolerance 1e-13", Points::all, 0, {}, {}}, "ode45",
      "the dissertation's reference: relative and absolute tolerance 1e-13",
      in_two_phases(Ode45{1e-13, 1e-13}, Ode45{1e-13, 1e-13}));
  add_explicit({"Explicit-1 (0.1; 0.5)",
                "Explicit-1",
                "0.1, 0.5 s",
                Points::ends,
                0,
                about(0.4554, digits, found),
                about(0.407, 2e-3, found),
                {},
                honest,
                fault},
               "explicit-1", 0.1, 0.5);
  add_explicit({"Explicit-2 (0.005; 0.006)",
                "Explicit-2",
                "0.005, 0.006 s",
                Points::ends,
                0,
                about(2.638e-4, digits, found),
                about(2.52e-3, 2e-3, found),
                {},
                honest,
                fault},
               "explicit-2", 0.005, 0.006);
  add({"RK4-1 (0.1; 0.5)", "RK4-1", "0.1, 0.5 s", Points::ends, 0, about(0.3982, 1e-3, end_twice),
       about(0.3986, 1e-3, end_twice)},
      "rk4-1", "classical method", phases(Rk4{}, 0.1, 0.5));
  add({"RK4-2 (0.05; 0.03)", "RK4-2", "0.05, 0.03 s", Points::ends, 0, about(2.895e-6, digits, found),
       about(2.884e-6, digits, found)},
      "rk4-2", "classical method", phases(Rk4{}, 0.05, 0.03));
  add({"Newmark-1 (0.1; 0.5)", "Newmark-1", "0.1, 0.5 s", Points::ends, 0, about(0.4563, 1e-3, end_twice),
       about(0.4568, 1e-3, end_twice)},
      "newmark-1", "beta = 1/4, gamma = 1/2, Newton to 1e-12", phases(Newmark{}, 0.1, 0.5));
  add({"Newmark-2 (0.05; 0.03)", "Newmark-2", "0.05, 0.03 s", Points::ends, 0, about(1.464e-2, digits, found),
       about(1.459e-2, digits, found)},
      "newmark-2", "beta = 1/4, gamma = 1/2, Newton to 1e-12", phases(Newmark{}, 0.05, 0.03));
  add({.row = "HHT-1 (0.1; 0.5)",
       .method = "HHT-1",
       .setting = "0.1, 0.5 s",
       .nominal = about(0.4044, 1e-3, end_twice),
       .inferred = about(0.4047, 1e-3, end_twice),
       .missing = alpha},
      "hht-1", "alpha = -0.1 (not stated), the method of 1977", phases(Hht{}, 0.1, 0.5));
  add({.row = "HHT-2 (0.05; 0.03)",
       .method = "HHT-2",
       .setting = "0.05, 0.03 s",
       .nominal = about(2.516e-2, digits, found),
       .inferred = about(2.507e-2, digits, found),
       .missing = alpha},
      "hht-2", "alpha = -0.1 (not stated), the method of 1977", phases(Hht{}, 0.05, 0.03));
  add({"MCPI-1 (0.1; 0.5)", "MCPI-1", "0.1, 0.5 s", Points::all, 0, about(1.01e-7, 5e-3, found),
       about(1.01e-7, 5e-3, found)},
      "mcpi-1", "order 6, 7 nodes, right-hand side to degree 5", phases(Mcpi{.order = 6}, 0.1, 0.5));
  add({"MCPI-2 (0.5; 2)", "MCPI-2", "0.5, 2 s", Points::all, 0, about(6.9e-7, 0.015, found),
       about(6.9e-7, 0.015, found)},
      "mcpi-2", "order 10, 11 nodes, right-hand side to degree 9", phases(Mcpi{.order = 10}, 0.5, 2));
  all.add({"RBF-Coll-1 (0.1; 0.5)",
           "RBF-Coll-1",
           "0.1, 0.5 s",
           Points::ends,
           0,
           about(0.33, 0.015, found),
           scattered(1.1e-6, 1.3e-6),
           {},
           "c = 2.5",
           "c = 2.5, then 0.66"},
          "rbf-1", "7 nodes, c = 2.5 in both intervals",
          phases(RbfCollocation{.nodes = 7, .shape = 2.5}, 0.1, 0.5),
          "7 nodes, c = 2.5 during the impact and 0.66 after it",
          in_two_phases(RbfCollocation{0.1, 7, 2.5}, RbfCollocation{0.5, 7, 0.66}));
  add({"RBF-Coll-2 (0.5; 6)", "RBF-Coll-2", "0.5, 6 s", Points::ends, 0, scattered(1.8e-7, 8.1e-7), {}},
      "rbf-2", "35 nodes, c = (N - 1)/(4 h), derivative matrix by LU",
      phases(RbfCollocation{.nodes = 35}, 0.5, 6));
  return all;
}

Example three_mass_rows() {
  // oracle: rbf_ivp_methods 4.6 RK4-? x1, 4.6 Newmark-? x1, 4.6 HHT-? x1, 4.6 MCPI-? x1, 4.6 Explicit-?
  // x1, 4.6 Explicit-? x3
  Example all{.made = three_mass_case,
              .name = "three-masses",
              .title = "Three masses",
              .table = "table-4.6",
              .quantity = "x1 RMS error",
              .window = 10,
              .borrowed = "load and damping (4.25) by the CMES paper, its Table 5 and (18)"};
  const auto add = [&](Row row, const std::string& run, const std::string& how, auto method) {
    all.add(std::move(row), run, how, throughout(method));
  };
  add({"", "ODE45", "tolerance 1e-13", Points::all, 0, {}, {}}, "ode45",
      "the dissertation's reference: relative and absolute tolerance 1e-13", Ode45{1e-13, 1e-13});
  const char* first_damping =
      "tools/oracles/rbf_ivp_methods.py, with the first damping force taken at v(-h/2)";
  add({"Explicit-1 (0.625)", "Explicit-1", "0.625 s", Points::ends, 2, about(0.0448, 5e-3, first_damping),
       about(0.1312, 5e-3, first_damping)},
      "explicit-1", "damping by extrapolated velocities", CentralDifference{0.625});
  add({"Explicit-2 (0.00625)", "Explicit-2", "0.00625 s", Points::ends, 2,
       about(5.95e-6, 5e-3, first_damping), about(1.444e-5, 5e-3, first_damping)},
      "explicit-2", "damping by extrapolated velocities", CentralDifference{0.00625});
  const auto same = [&](const std::string& row, const std::string& method, const std::string& step,
                        Points points,
                        const Expected& expected) { return Row{row, method, step, points, 0, expected, {}}; };
  add(same("RK4-1 (0.625)", "RK4-1", "0.625 s", Points::ends, about(4.582e-3, digits, found)), "rk4-1",
      "classical method", Rk4{0.625});
  add(same("RK4-2 (0.0625)", "RK4-2", "0.0625 s", Points::ends, about(5.067e-7, digits, found)), "rk4-2",
      "classical method", Rk4{0.0625});
  add(same("Newmark-1 (0.625)", "Newmark-1", "0.625 s", Points::ends, about(6.644e-2, digits, found)),
      "newmark-1", "beta = 1/4, gamma = 1/2, Newton to 1e-12", Newmark{0.625});
  add(same("Newmark-2 (0.0625)", "Newmark-2", "0.0625 s", Points::ends, about(1.187e-3, digits, found)),
      "newmark-2", "beta = 1/4, gamma = 1/2, Newton to 1e-12", Newmark{0.0625});
  for (Row row :
       {same("HHT-1 (0.625)", "HHT-1", "0.625 s", Points::ends, about(7.621e-2, digits, found)),
        same("HHT-2 (0.0625)", "HHT-2", "0.0625 s", Points::ends, about(1.489e-3, digits, found))}) {
    row.missing = "alpha is not stated";
    const bool first = row.method == "HHT-1";
    add(row, first ? "hht-1" : "hht-2", "alpha = -0.1 (not stated), the method of 1977",
        Hht{first ? 0.625 : 0.0625});
  }
  add(same("MCPI-1 (0.625)", "MCPI-1", "0.625 s", Points::all, about(5.80e-9, 1e-3, found)), "mcpi-1",
      "order 6, 7 nodes, right-hand side to degree 5", Mcpi{0.625, 6});
  add(same("MCPI-2 (4)", "MCPI-2", "4 s", Points::all, about(2.75e-9, 2e-3, found)), "mcpi-2",
      "order 12, 13 nodes, right-hand side to degree 11", Mcpi{4, 12});
  add(same("RBF-Coll-1 (0.625)", "RBF-Coll-1", "0.625 s", Points::ends, scattered(1.2e-8, 2.5e-8)), "rbf-1",
      "7 nodes, c = 0.35, derivative matrix by LU", RbfCollocation{0.625, 7, 0.35});
  add(same("RBF-Coll-2 (20)", "RBF-Coll-2", "20 s", Points::ends, scattered(3.7e-9, 7.4e-9)), "rbf-2",
      "35 nodes, c = 0.39, derivative matrix by LU", RbfCollocation{20, 35, 0.39});
  return all;
}

}  // namespace nlmech::chapters::rbf_ivp
