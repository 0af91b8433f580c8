#include "nlmech/peers/bvp/ipopt.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Ipopt::Index;
using Ipopt::Number;

/// The nonlinear program: variables x_0, u_0, x_1, u_1, ..., x_M, u_M; constraints x_{k+1} - x_k - h/2 (g_k +
/// g_{k+1}).
class Program final : public Ipopt::TNLP {
 public:
  Program(const bvp::ExtremalProblem& problem, const bvp::ControlGuess& guess, int pieces)
      : task_(problem.task()),
        model_(problem.model()),
        n_(model_.states()),
        q_(model_.controls()),
        m_(pieces),
        h_((task_.final_time - task_.begin_time) / pieces),
        plain_(task_.constraints),
        zero_(VectorXd::Zero(n_)) {
    plain_.penalty_weight = 0;
    integrate(guess);
  }

  MatrixXd z;                                         ///< result: states and controls, one node a column
  MatrixXd y;                                         ///< result: multipliers, one interval a column
  double cost = 0;                                    ///< result: cost
  Ipopt::SolverReturn ended = Ipopt::INTERNAL_ERROR;  ///< return code of Ipopt

  [[nodiscard]] const MatrixXd& start() const { return start_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = (m_ + 1) * block();
    m = m_ * n_;
    jacobian = m_ * n_ * 2 * block();
    hessian = (m_ + 1) * block() * (block() + 1) / 2 + n_ * n_;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* low, Number* high, Index m, Number* g_low, Number* g_high) override {
    constexpr double infinite = 2e19;  // exceeds Ipopt's threshold of infinity
    std::fill(low, low + n, -infinite);
    std::fill(high, high + n, infinite);
    std::fill(g_low, g_low + m, 0.0);
    std::fill(g_high, g_high + m, 0.0);
    const auto fix = [&](int k, int component, double value) {
      low[k * block() + component] = high[k * block() + component] = value;
    };
    for (int k = 0; k <= m_; ++k) {
      for (int i = 0; i < q_ && std::isfinite(plain_.control_limit); ++i) {
        low[k * block() + n_ + i] = -plain_.control_limit;
        high[k * block() + n_ + i] = plain_.control_limit;
      }
      for (const bvp::StateBound& bound : plain_.states) {
        low[k * block() + bound.component] = std::max(bound.low, -infinite);
        high[k * block() + bound.component] = std::min(bound.high, infinite);
      }
    }
    for (int i = 0; i < n_; ++i) {
      const auto& begin = task_.begin[static_cast<std::size_t>(i)];
      const auto& end = task_.end[static_cast<std::size_t>(i)];
      if (begin) fix(0, i, *begin);
      if (end) fix(m_, i, *end);
    }
    for (const bvp::Waypoint& w : task_.waypoints) {
      const long k = std::lround((w.t - task_.begin_time) / h_);
      fix(static_cast<int>(std::clamp<long>(k, 1, m_ - 1)), w.component, w.value);
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    Eigen::Map<MatrixXd>(x, block(), m_ + 1) = start_;
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    const Eigen::Map<const MatrixXd> at(x, block(), m_ + 1);
    VectorXd g(n_);
    value = end_cost(at).value;
    for (int k = 0; k <= m_; ++k) {
      value += weight(k) * model_.dynamics(time(k), at.col(k).head(n_), at.col(k).tail(q_), task_.mu, g);
    }
    return std::isfinite(value);
  }

  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    const Eigen::Map<const MatrixXd> at(x, block(), m_ + 1);
    Eigen::Map<MatrixXd> out(gradient, block(), m_ + 1);
    for (int k = 0; k <= m_; ++k) out.col(k) = weight(k) * expand(at, k, zero_).gradient;
    const bvp::EndCost phi = end_cost(at);
    out.col(0).head(n_) += phi.gradient.head(n_);
    out.col(m_).head(n_) += phi.gradient.segment(n_, n_);
    return out.allFinite();
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    const Eigen::Map<const MatrixXd> at(x, block(), m_ + 1);
    Eigen::Map<MatrixXd> out(g, n_, m_);
    VectorXd left(n_), right(n_);
    model_.dynamics(time(0), at.col(0).head(n_), at.col(0).tail(q_), task_.mu, left);
    for (int k = 0; k < m_; ++k) {
      model_.dynamics(time(k + 1), at.col(k + 1).head(n_), at.col(k + 1).tail(q_), task_.mu, right);
      out.col(k) = at.col(k + 1).head(n_) - at.col(k).head(n_) - h_ / 2 * (left + right);
      std::swap(left, right);
    }
    return out.allFinite();
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* rows, Index* columns,
                  Number* values) override {
    Index entry = 0;
    MatrixXd left, right;
    for (int k = 0; k < m_; ++k) {
      if (values != nullptr) {
        const Eigen::Map<const MatrixXd> at(x, block(), m_ + 1);
        left = k == 0 ? slopes(at, 0) : right;
        right = slopes(at, k + 1);
      }
      for (int side = 0; side < 2; ++side) {
        for (int i = 0; i < n_; ++i) {
          for (int j = 0; j < block(); ++j, ++entry) {
            if (values == nullptr) {
              rows[entry] = k * n_ + i;
              columns[entry] = (k + side) * block() + j;
            } else {
              const double own = i == j ? (side == 0 ? -1 : 1) : 0;
              values[entry] = own - h_ / 2 * (side == 0 ? left : right)(i, j);
            }
          }
        }
      }
    }
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* lambda, bool, Index,
              Index* rows, Index* columns, Number* values) override {
    Index entry = 0;
    for (int k = 0; k <= m_; ++k) {
      MatrixXd hessian;
      if (values != nullptr) hessian = node_hessian(x, k, factor, lambda);
      for (int i = 0; i < block(); ++i) {
        for (int j = 0; j <= i; ++j, ++entry) {
          if (values == nullptr) {
            rows[entry] = k * block() + i;
            columns[entry] = k * block() + j;
          } else {
            values[entry] = hessian(i, j);
          }
        }
      }
    }
    MatrixXd mixed;
    if (values != nullptr) {
      const Eigen::Map<const MatrixXd> at(x, block(), m_ + 1);
      mixed = factor * end_cost(at).hessian.block(n_, 0, n_, n_);
    }
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < n_; ++j, ++entry) {
        if (values == nullptr) {
          rows[entry] = m_ * block() + i;
          columns[entry] = j;
        } else {
          values[entry] = mixed(i, j);
        }
      }
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn status, Index, const Number* x, const Number*, const Number*,
                         Index, const Number*, const Number* lambda, Number value, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    ended = status;
    cost = value;
    z = Eigen::Map<const MatrixXd>(x, block(), m_ + 1);
    y = Eigen::Map<const MatrixXd>(lambda, n_, m_);
  }

 private:
  [[nodiscard]] int block() const { return n_ + q_; }
  [[nodiscard]] double time(int k) const { return task_.begin_time + k * h_; }
  [[nodiscard]] double weight(int k) const { return k == 0 || k == m_ ? h_ / 2 : h_; }

  template <class M>
  [[nodiscard]] bvp::HamiltonianExpansion expand(const M& at, int k, const VectorXd& lambda) const {
    return model_.expand(time(k), at.col(k).head(n_), at.col(k).tail(q_), lambda, task_.mu, plain_);
  }
  template <class M>
  [[nodiscard]] bvp::EndCost end_cost(const M& at) const {
    return model_.end_cost(at.col(0).head(n_), at.col(m_).head(n_), task_.final_time);
  }
  template <class M>
  [[nodiscard]] MatrixXd slopes(const M& at, int k) const {
    bvp::LinearDynamics linear;
    model_.linearise(time(k), at.col(k).head(n_), at.col(k).tail(q_), task_.mu, linear);
    MatrixXd both(n_, block());
    both << linear.g_x, linear.g_u;
    return both;
  }

  /// Second derivatives of the Lagrangian with respect to the variables of one node.
  MatrixXd node_hessian(const Number* x, int k, double factor, const Number* lambda) const {
    const Eigen::Map<const MatrixXd> at(x, block(), m_ + 1), multipliers(lambda, n_, m_);
    VectorXd nu = VectorXd::Zero(n_);
    if (k > 0) nu -= h_ / 2 * multipliers.col(k - 1);
    if (k < m_) nu -= h_ / 2 * multipliers.col(k);
    const MatrixXd of_cost = expand(at, k, zero_).hessian;
    MatrixXd hessian = factor * weight(k) * of_cost + (expand(at, k, nu).hessian - of_cost);
    if (k == 0) hessian.topLeftCorner(n_, n_) += factor * end_cost(at).hessian.topLeftCorner(n_, n_);
    if (k == m_) hessian.topLeftCorner(n_, n_) += factor * end_cost(at).hessian.block(n_, n_, n_, n_);
    return hessian;
  }

  void integrate(const bvp::ControlGuess& guess) {
    start_.resize(block(), m_ + 1);
    VectorXd x = guess.begin, u(q_), g(n_), half(n_);
    for (int i = 0; i < n_; ++i) {
      const auto& begin = task_.begin[static_cast<std::size_t>(i)];
      if (begin) x[i] = *begin;
    }
    for (int k = 0; k <= m_; ++k) {
      guess.control(time(k), u);
      start_.col(k) << x, u;
      model_.dynamics(time(k), x, u, task_.mu, g);
      model_.dynamics(time(k) + h_ / 2, x + h_ / 2 * g, u, task_.mu, half);
      x += h_ * half;
      if (!x.allFinite() || x.norm() > 1e6) x.setZero();  // any finite initial guess suffices
    }
  }

  const bvp::ControlTask& task_;
  const bvp::ControlModel& model_;
  int n_, q_, m_;
  double h_;
  bvp::Constraints plain_;
  VectorXd zero_;
  MatrixXd start_;
};

Status status_of(Ipopt::SolverReturn ended) {
  switch (ended) {
    case Ipopt::SUCCESS:
    case Ipopt::STOP_AT_ACCEPTABLE_POINT: return {};
    case Ipopt::LOCAL_INFEASIBILITY:
      return Status::failure(
          Outcome::infeasible,
          "ipopt: converged to a point at which the prescribed values cannot be met; loosen "
          "bounds, or start elsewhere");
    case Ipopt::MAXITER_EXCEEDED:
      return Status::failure(Outcome::step_limit, "ipopt: the iterations are used up; allow more");
    default:
      return failed_with(Outcome::not_converged,
                         "ipopt: ended with code {}; start elsewhere, or take more pieces",
                         static_cast<int>(ended));
  }
}

}  // namespace

bool ipopt_available() noexcept { return true; }

bvp::DirectResult ipopt_start(const bvp::ExtremalProblem& problem, const bvp::ControlGuess& guess,
                              const IpoptOptions& options) {
  if (options.pieces < 2 || options.pieces > 20000) {
    throw invalid_argument("ipopt_start: {} pieces; 2 to 20000 are allowed", options.pieces);
  }
  const Ipopt::SmartPtr<Program> program = new Program(problem, guess, options.pieces);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetIntegerValue("max_iter", options.iterations);
  application->Options()->SetNumericValue("tol", options.tolerance);
  // Prescribed values are fixed variables; their multipliers are not needed.
  application->Options()->SetStringValue("fixed_variable_treatment", "make_parameter");
  bvp::DirectResult result;
  if (application->Initialize() == Ipopt::Solve_Succeeded) {
    (void)application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(Ipopt::GetRawPtr(program)));
  }
  result.status = status_of(program->ended);
  result.start.parameters = problem.own_parameters();
  if (program->z.size() == 0) return result;
  result.cost = program->cost;
  const int n = problem.model().states(), m = options.pieces;
  // The multipliers of the constraints are -lambda in the middle of the intervals.
  MatrixXd table(2 * n, m + 1);
  table.topRows(n) = program->z.topRows(n);
  for (int k = 1; k < m; ++k) table.col(k).tail(n) = -(program->y.col(k - 1) + program->y.col(k)) / 2;
  // At the ends: linear extrapolation from the two nearest intervals.
  table.col(0).tail(n) = -(3 * program->y.col(0) - program->y.col(1)) / 2;
  table.col(m).tail(n) = -(3 * program->y.col(m - 1) - program->y.col(m - 2)) / 2;
  const double t0 = problem.task().begin_time, h = (problem.task().final_time - t0) / m;
  result.start.states = [table, t0, h](double t, VectorXd& at) {
    const double s = std::clamp((t - t0) / h, 0.0, static_cast<double>(table.cols() - 1));
    const Eigen::Index k = std::min<Eigen::Index>(static_cast<Eigen::Index>(s), table.cols() - 2);
    const double f = s - static_cast<double>(k);
    at = (1 - f) * table.col(k) + f * table.col(k + 1);
  };
  return result;
}

}  // namespace nlmech::peers
