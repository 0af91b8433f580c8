#include "chapters/homotopy/commands/frame_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "chapters/toml_file.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using frames::ModelPart;
using frames::Motion;

using MemberNumber = std::pair<std::string_view, double frames::NamedMember::*>;
constexpr std::array member_numbers = {
    MemberNumber{"EA", &frames::NamedMember::ea}, MemberNumber{"EI", &frames::NamedMember::ei},
    MemberNumber{"mass", &frames::NamedMember::mass}, MemberNumber{"radius", &frames::NamedMember::radius}};

/// Reader of one frame file.
class Reader {
 public:
  Reader(const toml::table& all, const std::string& name, const std::optional<std::string>& load_case)
      : case_(load_case) {
    file_.name = name;
    find_cases(all);
    for (const auto& [key, node] : in_order(all)) {
      if (key == "nodes")
        for_entries(key, *node, [this](const auto& k, const auto& n) { read_node(k, n); });
      else if (key == "members")
        for_tables(key, *node, [this](const auto& table) { read_member(table); });
      else if (key == "supports")
        for_entries(key, *node, [this](const auto& k, const auto& n) { read_support(k, n); });
      else if (key == "springs")
        for_tables(key, *node, [this](const auto& table) { read_spring(table); });
      else if (key == "loads")
        for_actions(key, *node, [this](const auto& k, const auto& n) { read_load("loads", k, n); });
      else if (key == "constant_loads")
        for_entries(key, *node, [this](const auto& k, const auto& n) { read_load("constant_loads", k, n); });
      else if (key == "displacements")
        for_actions(key, *node, [this](const auto& k, const auto& n) { read_displacement(k, n); });
      else if (key == "masses")
        for_entries(key, *node, [this](const auto& k, const auto& n) { read_mass(k, n); });
      else if (key == "damping")
        read_damping(*node);
      else if (key == "imperfection")
        read_imperfection(*node);
      else
        complain(*node, key,
                 "no such key; the keys are nodes, members, supports, springs, loads, constant_loads, "
                 "displacements, "
                 "masses, damping, imperfection");
    }
  }
  [[nodiscard]] FrameFile take() {
    for (auto& [name, other] : others_) file_.others.push_back(std::move(other));
    return std::move(file_);
  }

 private:
  using Entry = std::pair<std::string, const toml::node*>;

  /// Entries of a table in the order of the file; toml++ sorts them by key.
  static std::vector<Entry> in_order(const toml::table& table) {
    std::vector<Entry> entries;
    for (const auto& [key, node] : table) entries.emplace_back(std::string(key.str()), &node);
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      const auto &at = a.second->source().begin, &other = b.second->source().begin;
      return std::pair(at.line, at.column) < std::pair(other.line, other.column);
    });
    return entries;
  }

  [[noreturn]] void complain(const toml::node& node, const std::string& key, const std::string& what) const {
    chapters::complain(file_.name, node, key, what);
  }

  void note_line(ModelPart part, const toml::node& node) {
    file_.lines[static_cast<std::size_t>(part)].push_back(static_cast<int>(node.source().begin.line));
  }

  template <class Use>
  void for_entries(const std::string& key, const toml::node& node, const Use& use) {
    const toml::table* const table = node.as_table();
    if (table == nullptr) complain(node, key, "must be a table with a line for each node");
    for (const auto& [name, entry] : in_order(*table)) use(name, *entry);
  }

  /// Is the node the table of a load case, with a table as its first entry?
  static bool is_case(const toml::node& node) {
    const toml::table* const table = node.as_table();
    return table != nullptr && !table->empty() && in_order(*table).front().second->is_table();
  }

  /// Finds the load cases and sets the chosen one.
  void find_cases(const toml::table& all) {
    const toml::node* single = nullptr;
    for (const char* const key : {"loads", "displacements"}) {
      const toml::table* const table = all[key].as_table();
      if (table == nullptr) continue;
      for (const auto& [name, node] : in_order(*table)) {
        if (!is_case(*node))
          single = node;
        else
          cases_.insert(name);
      }
    }
    std::string names;
    for (const std::string& name : cases_) names.append(names.empty() ? "" : ", ").append(quoted_input(name));
    if (single != nullptr && !cases_.empty())
      throw InputError(
          fmt::format("{}, line {}: loads or displacements without a case beside cases ({}); put all of them "
                      "under a case, or none",
                      file_.name, single->source().begin.line, quoted_input(names, 400)));
    if (case_ && !cases_.contains(*case_))
      throw InputError(fmt::format(
          "{}, [loads]: there is no case {}; {}", file_.name, quoted_input(*case_),
          cases_.empty() ? "the file has no cases" : "the cases are " + quoted_input(names, 400)));
    if (!case_ && cases_.size() > 1)
      throw InputError(fmt::format("{}, [loads]: there are several cases; give --case with one of {}",
                                   file_.name, quoted_input(names, 400)));
    if (!case_ && cases_.size() == 1) case_ = *cases_.begin();
  }

  /// Moves the entries after the first @p count ones to another load case.
  template <class Entries>
  void hand_over(Entries frames::FrameModel::*list, ModelPart part, std::size_t count, FrameFile& to) {
    Entries& entries = file_.model.*list;
    auto &lines = file_.lines[static_cast<std::size_t>(part)],
         &other = to.lines[static_cast<std::size_t>(part)];
    for (std::size_t i = count; i < entries.size(); ++i) {
      (to.model.*list).push_back(std::move(entries[i]));
      other.push_back(lines[i]);
    }
    entries.resize(count);
    lines.resize(count);
  }

  /// Reads the loads or displacements of the chosen case. The other cases are read too, so that their errors
  /// are reported at once.
  template <class Use>
  void for_actions(const std::string& key, const toml::node& node, const Use& use) {
    if (cases_.empty()) return for_entries(key, node, use);
    for_entries(key, node, [&](const std::string& name, const toml::node& entries) {
      const std::size_t loads = file_.model.loads.size(), moves = file_.model.displacements.size();
      for_entries(key + '.' + name, entries, use);
      if (name == case_) return;
      FrameFile& other = others_[name];
      hand_over(&frames::FrameModel::loads, ModelPart::loads, loads, other);
      hand_over(&frames::FrameModel::displacements, ModelPart::displacements, moves, other);
    });
  }

  double number(const toml::node& node, const std::string& key) const {
    return number_of(file_.name, node, key);
  }

  std::string text(const toml::node& node, const std::string& key) const {
    const auto value = node.value_exact<std::string>();
    if (!value) complain(node, key, "must be a name in quotes");
    return *value;
  }

  std::vector<std::string> texts(const toml::node& node, const std::string& key) const {
    const toml::array* const array = node.as_array();
    if (array == nullptr) complain(node, key, "must be a list of names in quotes");
    std::vector<std::string> all;
    for (const toml::node& entry : *array) all.push_back(text(entry, key));
    return all;
  }

  void read_node(const std::string& name, const toml::node& node) {
    const std::string key = "nodes." + name;
    const toml::array* const place = node.as_array();
    if (place == nullptr || place->size() != 2)
      complain(node, key, "must be a position of two numbers, [x, y]");
    file_.model.nodes.push_back({name, number((*place)[0], key), number((*place)[1], key)});
    note_line(ModelPart::nodes, node);
  }

  /// Calls use(table) for the tables under [[key]].
  template <class Use>
  void for_tables(const std::string& key, const toml::node& node, const Use& use) {
    const std::string what = "must be tables, each under [[" + key + "]]";
    const toml::array* const all = node.as_array();
    if (all == nullptr) complain(node, key, what);
    for (const toml::node& entry : *all) {
      const toml::table* const table = entry.as_table();
      if (table == nullptr) complain(entry, key, what);
      use(*table);
    }
  }

  void require_keys(const toml::table& table, const char* what,
                    std::initializer_list<std::string_view> keys) const {
    for (const std::string_view key : keys) {
      if (!table.contains(key))
        throw InputError(
            fmt::format("{}, line {}: {} without {}", file_.name, table.source().begin.line, what, key));
    }
  }

  void read_member(const toml::table& table) {
    frames::NamedMember m;
    struct Hinge {
      std::string end;
      double stiffness;  // of the joint
      Entry from;
    };
    std::vector<Hinge> hinges;
    for (const auto& [key, node] : in_order(table)) {
      if (key == "nodes") {
        const std::vector<std::string> ends = texts(*node, key);
        if (ends.size() != 2) complain(*node, key, "a member joins two nodes");
        m.first = ends[0], m.second = ends[1];
      } else if (const auto number_of = std::ranges::find(member_numbers, key, &MemberNumber::first);
                 number_of != member_numbers.end()) {
        m.*number_of->second = number(*node, key);
      } else if (key == "elements") {
        m.elements = whole(*node, key);
      } else if (key == "hinges") {
        for (std::string& end : texts(*node, key)) hinges.push_back({std::move(end), 0., {key, node}});
      } else if (key == "joints") {
        for (const auto& [end, stiffness] : table_of(*node, key, "must be a table such as { A = 100 }"))
          hinges.push_back({end, number(*stiffness, key + "." + end), {key, node}});
      } else {
        complain(
            *node, key,
            "no such key; the keys of a member are nodes, EA, EI, hinges, joints, elements, radius, mass");
      }
    }
    require_keys(table, "a member", {"nodes", "EA", "EI"});
    for (const Hinge& h : hinges) {
      if (h.end != m.first && h.end != m.second)
        complain(*h.from.second, h.from.first,
                 fmt::format("the member joins {} and {}", quoted_input(m.first), quoted_input(m.second)));
      bool& is_pinned = h.end == m.first ? m.is_first_pinned : m.is_second_pinned;
      if (is_pinned)
        complain(*h.from.second, h.from.first,
                 fmt::format("the end {} has a hinge or a joint already; give it one", quoted_input(h.end)));
      is_pinned = true;
      (h.end == m.first ? m.first_joint : m.second_joint) = h.stiffness;
    }
    file_.model.members.push_back(std::move(m));
    note_line(ModelPart::members, table);
  }

  int whole(const toml::node& node, const std::string& key) const {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < 1 || *value > frames::most_beam_columns)
      complain(node, key, fmt::format("must be a whole number from 1 to {}", frames::most_beam_columns));
    return static_cast<int>(*value);
  }

  std::optional<Motion> motion_of(std::string_view word) const {
    for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
      if (word == to_string(motion)) return motion;
    }
    return std::nullopt;
  }

  void read_support(const std::string& name, const toml::node& node) {
    const std::string key = "supports." + name;
    for (const std::string& word : texts(node, key)) {
      const auto motion = motion_of(word);
      if (!motion) complain(node, key, quoted_input(word) + " is no motion; the motions are x, y, rotation");
      file_.model.supports.push_back({name, *motion});
      note_line(ModelPart::supports, node);
    }
  }

  void read_spring(const toml::table& table) {
    frames::NamedSpring s;
    for (const auto& [key, node] : in_order(table)) {
      if (key == "nodes") {
        std::vector<std::string> ends = texts(*node, key);
        if (ends.empty() || ends.size() > 2)
          complain(*node, key, "a spring has one node, and the ground, or two");
        s.second = std::move(ends.back());
        if (ends.size() == 2) s.first = std::move(ends.front());
      } else if (key == "direction") {
        read_direction(*node, s);
      } else if (key == "stiffness") {
        s.stiffness = number(*node, key);
      } else {
        complain(*node, key, "no such key; the keys of a spring are nodes, direction, stiffness");
      }
    }
    require_keys(table, "a spring", {"nodes", "direction", "stiffness"});
    file_.model.springs.push_back(std::move(s));
    note_line(ModelPart::springs, table);
  }

  void read_direction(const toml::node& node, frames::NamedSpring& s) const {
    if (const toml::array* const vector = node.as_array(); vector != nullptr && vector->size() == 2) {
      s.x = number((*vector)[0], "direction");
      s.y = number((*vector)[1], "direction");
      return;
    }
    const auto motion = motion_of(node.value_exact<std::string>().value_or(""));
    if (!motion) complain(node, "direction", "must be \"x\", \"y\", \"rotation\" or a vector [x, y]");
    s.x = *motion == Motion::x;
    s.y = *motion == Motion::y;
    s.turns = *motion == Motion::rotation;
  }

  void read_load(const std::string& part, const std::string& name, const toml::node& node) {
    const std::string key = part + "." + name;
    for (const auto& [word, value] : table_of(node, key, "a load is a table such as { y = -1 }")) {
      const auto motion = word == "moment" ? Motion::rotation : motion_of(word);
      if (!motion || word == "rotation") complain(*value, key + "." + word, "a load has x, y, moment");
      file_.model.loads.push_back(
          {name, *motion, number(*value, key + "." + word), part == "constant_loads"});
      note_line(ModelPart::loads, *value);
    }
  }

  void read_displacement(const std::string& name, const toml::node& node) {
    const std::string key = "displacements." + name;
    for (const auto& [word, value] : table_of(node, key, "a displacement is a table such as { y = -1 }")) {
      const auto motion = motion_of(word);
      if (!motion) complain(*value, key + "." + word, "a displacement has x, y, rotation");
      file_.model.displacements.push_back({name, *motion, number(*value, key + "." + word)});
      note_line(ModelPart::displacements, *value);
    }
  }

  void read_mass(const std::string& name, const toml::node& node) {
    frames::NamedMass mass{.node = name};
    read_numbers(node, "masses." + name, "a mass is a table such as { mass = 2 }", {"mass", &mass.mass},
                 {"inertia", &mass.inertia});
    file_.model.masses.push_back(mass);
    note_line(ModelPart::masses, node);
  }

  void read_damping(const toml::node& node) {
    frames::Damping& damping = file_.model.damping;
    read_numbers(node, "damping", "must be a table", {"mass", &damping.mass},
                 {"stiffness", &damping.stiffness});
    note_line(ModelPart::damping, node);
  }

  using NamedNumber = std::pair<std::string_view, double*>;
  /// Reads up to two named numbers.
  void read_numbers(const toml::node& node, const std::string& key, const char* what,
                    const NamedNumber& first, const NamedNumber& second) const {
    for (const auto& [word, value] : table_of(node, key, what)) {
      if (word != first.first && word != second.first)
        complain(*value, key + "." + word,
                 fmt::format("no such key; the keys are {}, {}", first.first, second.first));
      *(word == first.first ? first : second).second = number(*value, key + "." + word);
    }
  }

  void read_imperfection(const toml::node& node) {
    frames::Imperfection imperfection;
    bool has_amplitude = false;
    for (const auto& [word, value] : table_of(node, "imperfection", "must be a table")) {
      if (word == "mode") {
        imperfection.mode = whole(*value, "imperfection.mode");
      } else if (word == "amplitude") {
        imperfection.amplitude = number(*value, "imperfection.amplitude");
        has_amplitude = true;
      } else {
        complain(*value, "imperfection." + word, "no such key; the keys are mode, amplitude");
      }
    }
    if (!has_amplitude)
      throw InputError(fmt::format("{}, line {}: an imperfection without amplitude", file_.name,
                                   node.source().begin.line));
    file_.model.imperfection = imperfection;
    note_line(ModelPart::imperfection, node);
  }

  /// Entries of a table in the order of the file. @throws InputError if @p node is no table
  std::vector<Entry> table_of(const toml::node& node, const std::string& key, const char* what) const {
    const toml::table* const table = node.as_table();
    if (table == nullptr) complain(node, key, what);
    return in_order(*table);
  }

  FrameFile file_;
  std::optional<std::string> case_;
  std::set<std::string> cases_;
  std::map<std::string, FrameFile> others_;
};

std::string_view name_of(ModelPart part) {
  switch (part) {
    case ModelPart::nodes: return "nodes";
    case ModelPart::members: return "members";
    case ModelPart::supports: return "supports";
    case ModelPart::loads: return "loads";
    case ModelPart::displacements: return "displacements";
    case ModelPart::masses: return "masses";
    case ModelPart::damping: return "damping";
    case ModelPart::springs: return "springs";
    default: return "imperfection";
  }
}

}  // namespace

FrameFile parse_frame(std::string_view text, const std::string& name,
                      const std::optional<std::string>& load_case) {
  return Reader(parse_toml(text, name), name, load_case).take();
}

FrameFile read_frame(const std::string& path, const std::optional<std::string>& load_case) {
  return parse_frame(scene::read_whole(path), path == "-" ? "standard input" : echoed_path(path), load_case);
}

void complain_of(const FrameFile& file, const frames::ModelError& error) {
  const std::vector<int>& lines = file.lines[static_cast<std::size_t>(error.part())];
  const std::string where = error.index() < lines.size() ? fmt::format("line {}", lines[error.index()])
                                                         : fmt::format("[{}]", name_of(error.part()));
  throw InputError(fmt::format("{}, {}: {}", file.name, where, error.what()));
}

frames::NamedFrame build_frame(const FrameFile& file, int elements) {
  const auto built = [](const FrameFile& one, int count) {
    try {
      return build(one.model, count);
    } catch (const frames::ModelError& error) {
      complain_of(one, error);
    }
  };
  frames::NamedFrame frame = built(file, elements);
  // The validity of a load case does not depend on the number of elements; 2 have inner nodes, as more have.
  for (const FrameFile& other : file.others) {
    FrameFile whole = file;
    whole.model.loads = other.model.loads;
    whole.model.displacements = other.model.displacements;
    for (const ModelPart part : {ModelPart::loads, ModelPart::displacements})
      whole.lines[static_cast<std::size_t>(part)] = other.lines[static_cast<std::size_t>(part)];
    static_cast<void>(built(whole, std::min(elements, 2)));
  }
  return frame;
}

}  // namespace nlmech::chapters::homotopy
