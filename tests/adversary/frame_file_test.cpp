/// Whatever a file of a frame holds, it makes a frame that stands, or a sentence says what is wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "tests/adversary/mutation.hpp"

namespace nlmech::adversary::frame_file_test {
namespace {

using chapters::homotopy::build_frame;
using chapters::homotopy::parse_frame;

constexpr std::int64_t all_of_them = 300'000;

/// Is it a frame at rest, with a load and a stiffness that resists it?
bool stands(const std::string& text) {
  const auto file = parse_frame(text, "frame.toml");
  const frames::NamedFrame f = build_frame(file, 2);
  if (f.motions.empty() || !f.load.allFinite() || !(f.load.cwiseAbs().maxCoeff() > 0)) return false;
  for (const frames::NamedMember& m : file.model.members) {
    if (!(m.ea > 0 && m.ei > 0 && std::isfinite(m.ea) && std::isfinite(m.ei))) return false;
  }
  Eigen::SparseMatrix<double> k;
  return f.frame.tangent<double>(Eigen::VectorXd::Zero(f.frame.size()), k).ok();
}

TEST(AdversaryFrameFile, FramesAsToml) {
  static const std::vector<std::string> examples = {
      source_lines("chapters/homotopy/frames/toggle.toml", 40),
      source_lines("chapters/homotopy/frames/truss.toml", 40),
      source_lines("chapters/homotopy/frames/shallow-arch.toml", 40)};
  hunt({.quick = 1500, .full = all_of_them, .least_right = 0.02},
       [](Draw& draw) { return read_or_refused(damaged(draw, examples), stands); });
}

TEST(AdversaryFrameFile, DeepKeys) {
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
}  // namespace nlmech::adversary::frame_file_test
