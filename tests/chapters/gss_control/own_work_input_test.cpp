/// What `gss_control` refuses, and how it says so.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "nlmech/scene/program/files.hpp"
#include "tests/chapters/gss_control/program.hpp"

namespace nlmech::own_work_input_test {
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

// Data with which no number of double can be computed: a sentence, at once.
TEST(BadInput, SpacecraftBeyondTheRangeOfDouble) {
  const fs::path file = fs::temp_directory_path() / ("nlmech-far-" + std::to_string(::getpid()) + ".toml");
  for (const std::string text :
       {"length = 1e300", "length = 1e100", "length = 1e-100", "mass_per_length = 1e308",
        "youngs_modulus = 1e-308", "second_moment = 1e308", "tip_mass = 1e300", "hub_inertia = 1e308",
        "hub_radius = 1e200"}) {
    scene::write_whole(file, text + "\n");
    for (const std::string command :
         {"poles", "zeros", "response --omega 1", "step --until 1", "step --until 1 --gains 1,1,1"}) {
      const scene::Finished f = tests::run_words("gss_control", command + " --spacecraft " + file.string());
      EXPECT_EQ(f.exit_code, 2) << command << ' ' << text << f.errors;
      EXPECT_TRUE(f.output.empty());
      EXPECT_NE(f.errors.find("double precision"), std::string::npos) << f.errors;
    }
  }
  fs::remove(file);
}

// Each value of a spacecraft and each gain within the range, but at its far ends: a result of numbers, or a
// sentence.
TEST(ExtremeInput, GivesNumbersOrASentence) {
  const fs::path file = fs::temp_directory_path() / ("nlmech-end-" + std::to_string(::getpid()) + ".toml");
  const auto judge = [](const std::string& words) {
    const scene::Finished f = tests::run_words("gss_control", words);
    if (f.exit_code == 0) {
      for (const char* no_number : {"nan", "inf"})
        EXPECT_EQ(f.output.find(no_number), std::string::npos) << words;
    } else {
      EXPECT_TRUE(f.output.empty()) << words;
      EXPECT_GT(f.errors.size(), 20U) << words;
    }
  };
  for (const std::string text : {"length = 1e15", "length = 1e-15", "tip_mass = 1e60", "hub_inertia = 1e60",
                                 "hub_inertia = 0", "hub_radius = 1e30", "youngs_modulus = 1e-40"}) {
    scene::write_whole(file, text + "\n");
    for (const std::string command :
         {"poles", "zeros --count 3", "response --omega 1", "step --until 1 --gains 1,1,1"})
      judge(command + " --spacecraft " + file.string());
  }
  fs::remove(file);
  for (const std::string gains : {"1e300,0,1", "1,1e300,1", "1,0,1e300", "1e-300,0,1e-300",
                                  "1,-1.9999999999999998,1", "1e308,1e308,1e308", "0,0,0"}) {
    judge("step --until 1 --at 2 --gains " + gains);
    judge("poles --gains " + gains);
    judge("response --omega 1e-300,1,1e150 --at 2 --gains " + gains);
  }
  judge("response --omega 1e-300:1e300:9 --at 0,4");
  judge("step --until 1e-308 --at 4");
  judge("optimal-gains --deflection-weight 1e308 --torque-weight 1e-308");
  judge("optimal-gains --deflection-weight 0 --torque-weight 1e308 --pd");
}

// Undamped oscillations some 1e16 radians on, and t^2/2J beyond the largest double.
TEST(NumericalFailure, WhereRoundingLeavesThePhaseOpen) {
  const scene::Finished late = tests::run_words("gss_control", "step --until 1e15 --at 2");
  EXPECT_EQ(late.exit_code, 1) << late.output;
  EXPECT_NE(late.errors.find("outside_validity"), std::string::npos) << late.errors;
  EXPECT_NE(late.errors.find("phase"), std::string::npos) << late.errors;
  const scene::Finished never = tests::run_words("gss_control", "step --until 1e308");
  EXPECT_EQ(never.exit_code, 1) << never.output;
  EXPECT_NE(never.errors.find("not finite"), std::string::npos) << never.errors;
  // A controlled spacecraft has come to rest by then.
  const tests::Rows rest = tests::rows_of("step --gains 12,0,16 --until 1e300 --at 2");
  EXPECT_NEAR(rest.row.at(1).at(1), 1, 1e-12);
  EXPECT_NEAR(rest.row.at(1).at(3), 0, 1e-12);
}

// Any consistent units: what is a file of ft and lb or of m and N is not for the help to say.
TEST(Help, NamesTheKeysAndNoUnitsOfTheUsers) {
  for (const std::string command : {"poles", "zeros", "response", "step", "optimal-gains"}) {
    const scene::Finished f = tests::run_words("gss_control", command + " --help");
    EXPECT_EQ(f.exit_code, 0);
    EXPECT_NE(f.output.find("consistent units"), std::string::npos) << f.output;
    EXPECT_NE(f.output.find("mass_per_length"), std::string::npos) << f.output;
    EXPECT_EQ(f.output.find("ft from the rim"), std::string::npos) << f.output;
    EXPECT_EQ(f.output.find("1/ft^2"), std::string::npos) << f.output;
  }
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
}  // namespace nlmech::own_work_input_test
