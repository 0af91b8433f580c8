/// Manual page and completions: made of the declared options, and understood by those who read them.
#include "nlmech/scene/program/manual.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "nlmech/scene/program/process.hpp"

namespace nlmech::scene::manual_test {
namespace {

struct Typed {
  std::string frame = "fixed";
  double step = 0.5;
  std::vector<std::string> scenes;
  bool quick = false;
};

void declare_flight(Options& options, Typed& t) {
  options.add("scenes", t.scenes, "what is flown");
  options.add("--frame", t.frame, "of reference").one_of({"fixed", "turning"});
  options.add("--step", t.step, "length of a step").positive();
  options.add("--quick", t.quick, "not all of it");
  options.footer("Notes:\n.a begins with a dot, C:\\path");
}

void declare_landing(Options& options, Typed& /*t*/) { options.unlimited(); }

Commands declared() {
  Commands commands("orbiter");
  const auto nothing = [](const Typed&) { return 0; };
  commands.add("fly", "Leaves, and says when it's there", declare_flight, nothing);
  commands.add("land", "Comes down", declare_landing, nothing);
  return commands;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ManualPage, ListsCommandsWithTheirOptions) {
  const std::string page = manual_page(declared(), "Flies", "2.0.0");
  EXPECT_TRUE(
      page.starts_with(".TH ORBITER 1 \"\" \"nlmech 2.0.0\" \"nlmech\"\n.SH NAME\norbiter \\- Flies\n"))
      << page;
  EXPECT_TRUE(has(page, ".SS fly [scenes...]\nLeaves, and says when it's there\n")) << page;
  EXPECT_TRUE(
      has(page, ".TP\n\\fB\\-\\-frame\\fR \\fITEXT\\fR\nof reference: fixed, turning; fixed without it\n"))
      << page;
  EXPECT_TRUE(has(page, "\nlength of a step; positive; 0.5 without it\n")) << page;
  EXPECT_TRUE(has(page, ".TP\n\\fB\\-\\-quick\\fR\nnot all of it\n")) << page;
  EXPECT_TRUE(has(page, "\n\\&.a begins with a dot, C:\\epath\n")) << "nothing typed is a request\n" << page;
  EXPECT_TRUE(has(page, "s; 60 without it")) << "the limit of every command";
  EXPECT_TRUE(has(page, "s; no limit without it"));
  EXPECT_EQ(page, manual_page(declared(), "Flies", "2.0.0"));
}

/// What bash offers after these words, of which the last is being typed.
std::string offered(const std::string& words, const std::string& last, const std::string& before) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("nlmech-completion" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "completions") << bash_completion(declared());
  // The program itself, as far as its list of scenes goes.
  std::ofstream(folder / "orbiter") << "#!/bin/sh\nprintf 'Title\\n\\n| scene | place |\\n| :--- | :--- |\\n"
                                       "| moon | a |\\n| fig-2 | b |\\n'\n";
  fs::permissions(folder / "orbiter", fs::perms::owner_all);
  const std::string script = "set -u; . ./completions; COMP_WORDS=(" + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nlmech_orbiter ./orbiter '" + last +
                             "' '" + before +
                             "'; echo ${COMPREPLY[@]+\"${COMPREPLY[*]}\"}; complete -p orbiter";
  const Finished run = run_program({"bash", "-c", script}, folder);
  fs::remove_all(folder);
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_TRUE(has(run.output, "complete -o default -F _nlmech_orbiter orbiter")) << run.output;
  return run.output.substr(0, run.output.find('\n'));
}

TEST(BashCompletion, OffersCommandsOptionsValuesAndScenes) {
  EXPECT_EQ(offered("orbiter ''", "", "orbiter"), "fly land --help --version");
  EXPECT_EQ(offered("orbiter l", "l", "orbiter"), "land");
  EXPECT_EQ(offered("orbiter fly --", "--", "fly"), "--help --frame --step --quick --limit");
  EXPECT_EQ(offered("orbiter fly --frame ''", "", "--frame"), "fixed turning");
  EXPECT_EQ(offered("orbiter fly ''", "", "fly"), "--help --frame --step --quick --limit moon fig-2");
  EXPECT_EQ(offered("orbiter land ''", "", "land"), "--help --limit");
  EXPECT_EQ(offered("orbiter nowhere ''", "", "nowhere"), "");
}

}  // namespace
}  // namespace nlmech::scene::manual_test
