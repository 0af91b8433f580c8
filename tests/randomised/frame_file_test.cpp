/// A file of a frame in any state gives a stable frame or a message that names the error.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "tests/randomised/mutation.hpp"

namespace nlmech::randomised::frame_file_test {
namespace {

using chapters::homotopy::build_frame;
using chapters::homotopy::parse_frame;

constexpr std::int64_t all_of_them = 300'000;

/// Is it a frame at rest with a load or a prescribed displacement, and a positive stiffness?
bool stands_in(const std::string& text, const std::optional<std::string>& load_case) {
  const auto file = parse_frame(text, "frame.toml", load_case);
  const frames::NamedFrame f = build_frame(file, 2);
  if (!f.load.allFinite() || !f.displacement.allFinite()) return false;
  if (!(f.load.cwiseAbs().maxCoeff() > 0 || f.displacement.cwiseAbs().maxCoeff() > 0)) return false;
  for (const Eigen::Index at : f.given) {
    if (f.load[at] != 0) return false;
  }
  for (const frames::NamedMember& m : file.model.members) {
    if (!(m.ea > 0 && m.ei > 0 && std::isfinite(m.ea) && std::isfinite(m.ei))) return false;
  }
  if (!(f.mass.minCoeff() >= 0 && f.mass.allFinite())) return false;
  const auto& imperfection = file.model.imperfection;
  if (imperfection && !(imperfection->mode >= 1 && std::isfinite(imperfection->amplitude))) return false;
  for (const auto& [entries, part] : {std::pair{file.model.loads.size(), frames::ModelPart::loads},
                                      {file.model.displacements.size(), frames::ModelPart::displacements},
                                      {file.model.masses.size(), frames::ModelPart::masses}}) {
    if (file.lines[static_cast<std::size_t>(part)].size() != entries) return false;
  }
  Eigen::SparseMatrix<double> k;
  return f.frame.tangent<double>(Eigen::VectorXd::Zero(f.frame.size()), k).ok();
}

bool stands(const std::string& text) { return stands_in(text, {}); }

TEST(RandomisedFrameFile, FramesAsToml) {
  static const std::vector<std::string> examples = {
      source_lines("chapters/homotopy/frames/toggle.toml", 40),
      source_lines("chapters/homotopy/frames/truss.toml", 40),
      source_lines("chapters/homotopy/frames/shallow-arch.toml", 40),
      source_lines("chapters/homotopy/frames/level-brace.toml", 40),
      source_lines("chapters/homotopy/frames/spring-column.toml", 40),
      source_lines("chapters/homotopy/frames/joint-cantilever.toml", 40),
      source_lines("chapters/homotopy/frames/heavy-column.toml", 40)};
  randomised_test({.quick = 1500, .full = all_of_them, .least_right = 0.02},
                  [](Draw& draw) { return read_or_refused(damaged(draw, examples), stands); });
}

TEST(RandomisedFrameFile, LoadCases) {
  static const std::vector<std::string> examples = {
      source_lines("chapters/homotopy/frames/cases.toml", 60),
      source_lines("chapters/homotopy/frames/cases.toml", 60) +
          "[masses]\ntip = { mass = 1, inertia = 2 }\n[damping]\nmass = 0.1\nstiffness = 1e-3\n"};
  randomised_test({.quick = 1500, .full = all_of_them, .least_right = 0.02}, [](Draw& draw) {
    const std::string text = damaged(draw, examples);
    const char* const names[] = {"weight", "twist", "lift"};
    const std::optional<std::string> load_case = names[draw.whole(0, 2)];
    return read_or_refused(text, [&](const std::string& t) { return stands_in(t, load_case); });
  });
}

TEST(RandomisedFrameFile, DeepKeys) {
  for (const std::size_t tables : {100U, 1900U, 30'000U, 1'000'000U}) {
    for (const char* const part : {"a.", "1.", "1.1 .", "'a' . "}) {
      std::string key;
      for (std::size_t i = 0; i < tables; ++i) key += part;
      for (const std::string& text : {key + "b = 1\n", '[' + key + "b]\nc = 1\n", "x = {" + key + "b = 1}\n"})
        EXPECT_EQ(read_or_refused(text, stands).verdict, Case::Verdict::refused) << tables << part;
    }
  }
}

}  // namespace
}  // namespace nlmech::randomised::frame_file_test
