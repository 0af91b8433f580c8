/// What `gss_control` refuses, and how it says so.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "nlmech/scene/files.hpp"
#include "tests/chapters/gss_control/program.hpp"

namespace nlmech {
namespace {

namespace fs = std::filesystem;

TEST(BadInput, WordsAreRefusedByValue) {
  struct Case {
    std::string words, named;
  };
  for (const Case& c : {Case{"poles --count 0", "0"},
                        Case{"poles --count 2.5", "2.5"},
                        Case{"poles --gains 1,1", "1,1"},
                        Case{"poles --gains 1,-2,1", "-2"},
                        Case{"poles --gains 1,nan,1", "nan"},
                        Case{"poles --spacecraft /no/such/file.toml", "/no/such/file.toml"},
                        Case{"zeros --at 5", "5"},
                        Case{"zeros --at 0", "0"},
                        Case{"zeros --at 1,2", "1,2"},
                        Case{"response", "--omega"},
                        Case{"response --omega x", "x"},
                        Case{"response --omega 0", "0"},
                        Case{"response --omega 1:2", "1:2"},
                        Case{"response --omega 1 --at 4.5", "4.5"},
                        Case{"response --omega inf", "inf"},
                        Case{"step", "--until"},
                        Case{"step --until -1", "-1"},
                        Case{"step --until 1 --every 0", "0"},
                        Case{"step --until 1 --final-angle 1", "--final-angle"},
                        Case{"step --until 1 --gains 1,1,1 --final-angle nan", "nan"},
                        Case{"optimal-gains", "--deflection-weight"},
                        Case{"optimal-gains --deflection-weight -1 --torque-weight 1", "-1"},
                        Case{"optimal-gains --deflection-weight 1 --torque-weight 0", "0"}}) {
    const scene::Finished f = tests::run_words("gss_control", c.words);
    EXPECT_EQ(f.exit_code, 2) << c.words << f.errors;
    EXPECT_TRUE(f.output.empty()) << c.words;
    EXPECT_NE(f.errors.find(c.named), std::string::npos) << c.words << ": " << f.errors;
  }
}

TEST(BadInput, FilesAreRefusedByLineKeyAndValue) {
  const fs::path file = fs::temp_directory_path() / ("nlmech-bad-" + std::to_string(::getpid()) + ".toml");
  struct Case {
    std::string text;
    std::vector<std::string> named;
  };
  for (const Case& c :
       {Case{"length = 4\nmass = 3\n", {"line 2", "mass", "3"}},
        Case{"length = \"4\"\n", {"line 1", "length", "4", "number"}},
        Case{"\n\nyoungs_modulus = -1\n", {"line 3", "youngs_modulus", "-1"}},
        Case{"tip_mass = nan\n", {"line 1", "tip_mass", "nan"}}, Case{"length 4\n", {"line 1"}}}) {
    scene::write_whole(file, c.text);
    for (const std::string command : {"poles", "zeros", "response --omega 1", "step --until 1",
                                      "optimal-gains --deflection-weight 1 --torque-weight 1"}) {
      const scene::Finished f = tests::run_words("gss_control", command + " --spacecraft " + file.string());
      EXPECT_EQ(f.exit_code, 2) << command << f.errors;
      EXPECT_TRUE(f.output.empty());
      EXPECT_NE(f.errors.find(file.string()), std::string::npos) << f.errors;
      for (const std::string& word : c.named)
        EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors << " lacks " << word;
    }
  }
  fs::remove(file);
}

// On a pole there is no response: exit code 1, and the outcome by its name.
TEST(NumericalFailure, OnAPole) {
  const auto poles = tests::rows_of("poles --count 1");
  const scene::Finished f = tests::run_words(
      "gss_control", "response --omega " + [&] {
        char text[40];
        static_cast<void>(std::snprintf(text, sizeof text, "%.17g", poles.row.at(0).at(2)));
        return std::string(text);
      }());
  EXPECT_EQ(f.exit_code, 1) << f.output;
  EXPECT_NE(f.errors.find("at_pole"), std::string::npos) << f.errors;
  EXPECT_TRUE(f.output.empty());
}

}  // namespace
}  // namespace nlmech
