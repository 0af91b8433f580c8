/// For any content of a file or option its reader returns that content or a message that names the error.
/// With sanitizers this is a fuzzer of all readers of the common layer.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/command.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/randomised/mutation.hpp"

namespace nlmech::randomised::readers_test {
namespace {

constexpr std::int64_t all_of_them = 1'000'000;

const std::vector<std::string>& points() {
  static const std::vector<std::string> all = {
      "x,y,z\n1,2,3\n-4.5e3,0.25,1e-3\n",        "6378137,0,0\n",
      "# a comment\nx,y,z\n+1, 2 ,3\n\n7,8,9",   "x,y,z\r\n1,2,3\r\n",
      "\xEF\xBB\xBFx,y,z\n0,0,6356752.314245\n", "1,2,3\n4,5,6\n7,8,9\n10,11,12\n",
      "t,\"Z\",Y,X,\n1,3,2,\"1\",\n#2,6,5,4,\n", "name,x,y,z\n\"a, b\",1,2,3\n#4,5,6,7\n"};
  return all;
}

// The number of rows equals that of non-blank lines; every number is finite; printed numbers read back
// unchanged.
TEST(RandomisedReaders, ColumnsOfNumbers) {
  const std::vector<std::string> names = {"x", "y", "z"};
  randomised_test({.quick = 3000, .full = all_of_them, .least_right = 0.02}, [&](Draw& draw) {
    return read_or_refused(damaged(draw, points()), [&](const std::string& text) {
      const scene::NumberColumns read = scene::parse_numbers(text, "points.csv", names);
      std::string again;
      for (std::size_t i = 0; i < read.rows(); ++i) {
        for (const auto& column : read.column) {
          if (column.size() != read.rows() || !std::isfinite(column[i])) return false;
        }
        again +=
            fmt::format("{:.17g},{:.17g},{:.17g}\n", read.column[0][i], read.column[1][i], read.column[2][i]);
      }
      const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
      return read.rows() <= lines && scene::parse_numbers(again, "again", names).column == read.column;
    });
  });
}

// Records written as CSV are read back unchanged.
TEST(RandomisedReaders, RecordsOfTexts) {
  static const std::vector<std::string> examples = {
      source_lines("tables/places.csv", 12), source_lines("tables/published/laier.csv", 6),
      "a,b\n\"1,2\",\"say \"\"x\"\"\"\n", "a\n\"two\nlines\"\n,\n", "\"\",x\n"};
  randomised_test({.quick = 2000, .full = all_of_them, .least_right = 0.02}, [&](Draw& draw) {
    return read_or_refused(damaged(draw, examples), [](const std::string& text) {
      const auto read = scene::parse_csv(text, "file.csv");
      std::string again;
      for (const scene::CsvRecord& record : read) {
        std::string line;
        for (const std::string& cell : record.cells) {
          line += line.empty() && &cell == record.cells.data() ? "" : ",";
          line += cell.empty() ? "\"\"" : scene::csv_field(cell);
        }
        again += line + '\n';
      }
      const auto twice = scene::parse_csv(again, "again");
      // A record of one blank cell is a blank line; only such records may be lost.
      std::vector<std::vector<std::string>> a, b;
      const auto counts = [](const scene::CsvRecord& r) {
        return r.cells.size() > 1 || r.cells[0].find_first_not_of(" \t\r") != std::string::npos;
      };
      for (const auto& r : read) {
        if (counts(r)) a.push_back(r.cells);
      }
      for (const auto& r : twice) {
        if (counts(r)) b.push_back(r.cells);
      }
      return a == b;
    });
  });
}

TEST(RandomisedReaders, PublishedTables) {
  static const std::vector<std::string> examples = {source_lines("tables/published/laier.csv", 8),
                                                    source_lines("tables/published/roy.csv", 8)};
  randomised_test({.quick = 500, .full = all_of_them, .least_right = 0.005}, [&](Draw& draw) {
    return read_or_refused(damaged(draw, examples), [](const std::string& text) {
      for (const scene::PublishedValue& value : scene::parse_published(text, "laier", "laier.csv")) {
        if (!std::isfinite(value.value)) return false;
      }
      return true;
    });
  });
}

TEST(RandomisedReaders, Places) {
  static const std::vector<std::string> examples = {source_lines("tables/places.csv", 20)};
  randomised_test({.quick = 250, .full = all_of_them, .least_right = 0.01}, [&](Draw& draw) {
    return read_or_refused(damaged(draw, examples), [](const std::string& text) {
      static_cast<void>(scene::parse_places(text, "places.csv"));
      return true;
    });
  });
}

TEST(RandomisedReaders, NumbersAndListsAsTyped) {
  static const std::vector<std::string> examples = {"1",       "-0.5",     "1e-9", "1,2,3",
                                                    "7e6,0,0", "0.01,100", "12",   "+3"};
  randomised_test({.quick = 3000, .full = all_of_them, .least_right = 0.02}, [&](Draw& draw) {
    const int kind = draw.whole(0, 3);
    return read_or_refused(damaged(draw, examples), [kind](const std::string& text) {
      if (kind == 0) return std::isfinite(scene::typed_number("--x", text));
      if (kind == 1) return scene::typed_positive("--x", text) > 0;
      if (kind == 2) {
        const int n = scene::typed_whole("--x", text, -3, 1000);
        return n >= -3 && n <= 1000;
      }
      const std::vector<double> all = scene::typed_numbers("--x", text);
      return std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); }) &&
             all.size() == static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')) + 1;
    });
  });
}

/// What a program writes to its two streams, read concurrently.
class Streams {
 public:
  Streams() {
    for (const int stream : {1, 2}) {
      int ends[2] = {-1, -1};
      EXPECT_EQ(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
      before_.at(place(stream)) = ::dup(stream);
      ::dup2(ends[1], stream);
      ::close(ends[1]);
      read_.at(place(stream)) = ends[0];
    }
  }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  ~Streams() {
    for (const int stream : {1, 2}) {
      ::dup2(before_.at(place(stream)), stream);
      ::close(before_.at(place(stream)));
      ::close(read_.at(place(stream)));
    }
  }
  std::string written(int stream) {
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(read_.at(place(stream)), buffer.data(), buffer.size());
    return {buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
  }

 private:
  static std::size_t place(int stream) { return static_cast<std::size_t>(stream - 1); }
  std::array<int, 2> before_{}, read_{};
};

/// The values of one option of each kind.
struct Typed {
  double number = 0, positive = 0;
  int whole = 3;
  std::optional<double> perhaps;
  std::vector<double> list;
  std::array<double, 3> place = {};
  std::string file, choice;
  std::vector<std::string> set;
  bool flag = false;
};

void declare(scene::Options& options, Typed& typed) {
  options.add("--number", typed.number, "a number");
  options.add("--positive", typed.positive, "a positive number").positive().required();
  options.add("--whole", typed.whole, "a whole number").range(1, 9);
  options.add("--perhaps", typed.perhaps, "a number or none").range(-1, 1);
  options.add("--list", typed.list, "numbers");
  options.add("--place", std::span<double>(typed.place), "three numbers");
  options.add("--choice", typed.choice, "a word").one_of({"left", "right"});
  options.add("--set", typed.set, "name=value");
  options.add("file", typed.file, "a file");
  options.add("--flag", typed.flag, "a flag");
}

/// A program with an option of each kind.
int program(const std::vector<std::string>& words) {
  scene::Commands commands("program");
  commands.add("work", "all kinds of options", declare, [](const Typed& t) {
    for (const std::string& s : t.set) {
      if (s.find('=') == std::string::npos) throw InputError(fmt::format("--set {}: must be name=value", s));
    }
    return fmt::format("{},{},{},{},{}\n", t.positive, t.number, t.whole, t.list.size(), t.flag);
  });
  std::vector<const char*> argv = {"program"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return scene::run_command(commands, "a program", static_cast<int>(argv.size()), argv.data());
}

// Exit code 0 with a result and no message, or 2 with a short printable message and no result.
TEST(RandomisedReaders, CommandLines) {
  static const std::vector<std::string> examples = {
      "work --positive 1",
      "work --positive 1e-3 --number -2 --whole 4 file.csv",
      "work --positive 2 --list 1,2,3 --flag",
      "work --positive 2 --place 1,2,3 --choice left --perhaps 0.5",
      "work --positive=5 --set a=1 --set b=2",
      "--help",
      "work --help",
      "--version",
      "work --limit 5 --positive 1 --",
      "work --positive 1 --number 1 --number 2",
      "work --limit 0 --positive 1"};
  randomised_test({.quick = 1000, .full = all_of_them, .least_right = 0.02}, [&](Draw& draw) {
    const std::string line = damaged(draw, examples);
    Streams streams;
    const int code = program(scene::split(line, ' '));
    const std::string result = streams.written(1), said = streams.written(2);
    if (code == 0 && !result.empty() && said.empty()) return Case::judged(0, 1, shown(line));
    std::string text = said;  // line ends are not part of the message
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::replace(text.begin(), text.end(), '\t', ' ');
    if (code == 2 && result.empty() && is_sentence(text)) return Case::refused(shown(line));
    return Case::wrong(fmt::format("exit code {}, result {}, message {}; {}", code, shown(result),
                                   shown(said), shown(line)));
  });
}

}  // namespace
}  // namespace nlmech::randomised::readers_test
