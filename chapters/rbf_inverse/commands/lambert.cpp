#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "chapters/rbf_inverse/commands/porkchop_file.hpp"
#include "chapters/rbf_inverse/lambert/porkchop_map.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "nlmech/scene/gnuplot.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

/// What was typed.
struct Words {
  std::string from, to, time, mu, revolutions = "0", branch, plane, zonal, radius, method = "izzo";
  bool long_way = false;
  std::string file, grid, shard, threads = "0";
  bool plot = false;
  std::vector<std::string> parts;
};

/// Two texts with a mark between.
std::pair<std::string, std::string> halves(const char* option, const std::string& text, char mark) {
  const std::size_t place = text.find(mark);
  if (place == std::string::npos)
    throw InputError(fmt::format("{} {}: needs two numbers and '{}'", option, text, mark));
  return {text.substr(0, place), text.substr(place + 1)};
}

orbit::Vector3<double> vector(const char* option, const std::string& text) {
  const std::vector<double> all = scene::typed_numbers(option, text);
  if (all.size() != 3)
    throw InputError(fmt::format("{} {}: {} numbers where x,y,z are needed", option, text, all.size()));
  return {all[0], all[1], all[2]};
}

orbit::TransferProblem problem_of(const Words& words) {
  orbit::TransferProblem p{
      vector("--from", words.from),
      vector("--to", words.to),
      scene::typed_positive("--time", words.time),
      {.mu = words.mu.empty() ? orbit::earth().mu : scene::typed_positive("--mu", words.mu)}};
  for (const auto& [option, r] : {std::pair("--from " + words.from, p.from), {"--to " + words.to, p.to}}) {
    if (r.isZero(0)) throw InputError(option + ": is the centre, from where no orbit leads on");
  }
  if (!words.plane.empty()) {
    p.normal = vector("--plane", words.plane);
    if (p.normal->isZero(0)) throw InputError(fmt::format("--plane {}: a normal cannot be 0", words.plane));
    if (!orbit::are_opposite({p.from, p.to, p.time, p.gravity.mu}))
      throw InputError(fmt::format(
          "--plane {}: the positions are not opposite and determine the plane; leave it out", words.plane));
  }
  if (words.zonal.empty() != words.radius.empty())
    throw InputError(words.zonal.empty()
                         ? fmt::format("--radius {}: means nothing without --zonal J2", words.radius)
                         : fmt::format("--zonal {}: needs --radius R", words.zonal));
  if (!words.zonal.empty()) {
    p.gravity.zonal[0] = scene::typed_number("--zonal", words.zonal);
    p.gravity.radius = scene::typed_positive("--radius", words.radius);
  }
  return p;
}

orbit::LambertArc arc_of(const Words& words) {
  orbit::LambertArc arc{words.long_way, scene::typed_whole("--revolutions", words.revolutions, 0, 1'000'000),
                        orbit::LambertBranch::low};
  if (arc.revolutions > 0 && words.branch.empty())
    throw InputError(fmt::format("--revolutions {}: needs --branch low or high", words.revolutions));
  if (arc.revolutions == 0 && !words.branch.empty())
    throw InputError(fmt::format("--branch {}: means nothing without revolutions", words.branch));
  if (words.branch == "high")
    arc.branch = orbit::LambertBranch::high;
  else if (!words.branch.empty() && words.branch != "low")
    throw InputError(fmt::format("--branch {}: there are low and high", words.branch));
  return arc;
}

/// Collocation with polynomials, from the guess that turns about the centre the short way.
orbit::Transfer by_collocation(const orbit::TransferProblem& p, const Words& words,
                               const orbit::LambertArc& arc) {
  if (arc.revolutions > 0)
    throw InputError(
        fmt::format("--method collocation --revolutions {}: no guess is known from which collocation "
                    "finds an arc of whole revolutions; use --method izzo",
                    words.revolutions));
  if (arc.long_way)
    throw InputError(
        "--method collocation --long-way: from simple guesses Newton's iteration ends on the short way; use "
        "--method izzo");
  constexpr int nodes = 81;
  orbit::Transfer t = orbit::collocate(p, {.nodes = nodes});
  if (!t.status.ok())
    t.status = Status::failure(t.status.outcome(),
                               fmt::format("lambert: collocation with {} nodes finds no transfer that "
                                           "integration confirms (the miss is {:.3g} "
                                           "where {:.3g} is allowed); use --method izzo",
                                           nodes, t.miss, orbit::largest_miss * p.to.stableNorm()));
  const orbit::Vector3<double> plane = orbit::cross(p.from, p.to);
  if (t.status.ok() && plane.dot(orbit::cross(p.from, t.v1)) < 0)
    t.status = Status::failure(Outcome::spurious_root,
                               "lambert: collocation has ended on the arc the long way; use --method izzo");
  return t;
}

std::string lambert(const Words& words) {
  const orbit::TransferProblem p = problem_of(words);
  const orbit::LambertArc arc = arc_of(words);
  if (words.method != "izzo" && words.method != "collocation")
    throw InputError(fmt::format("--method {}: there are izzo and collocation", words.method));
  orbit::Transfer t;
  try {
    t = words.method == "izzo" ? orbit::corrected_transfer(p, arc) : by_collocation(p, words, arc);
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what());
  }
  if (t.status.outcome() ==
      Outcome::outside_validity)  // positions that determine no plane, an impossible time
    throw InputError(fmt::format("--from {} --to {} --time {}: {}", words.from, words.to, words.time,
                                 t.status.sentence()));
  if (!t.status.ok()) throw Failure(t.status);
  return fmt::format(
      "vx0,vy0,vz0,vx1,vy1,vz1,miss_m\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.3g}\n", t.v1[0],
      t.v1[1], t.v1[2], t.v2[0], t.v2[1], t.v2[2], t.miss);
}

/// A folder for the data of a drawing, gone with it.
class Scratch {
 public:
  Scratch() : path_(std::filesystem::temp_directory_path() / fmt::format("nlmech-porkchop-{}", ::getpid())) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The power of a thousand in which numbers up to @p largest are short, and how a label says so.
std::pair<double, std::string> short_unit(double largest, const std::string& label) {
  if (!(largest >= 1e4 || (largest > 0 && largest < 1e-2))) return {1, label};
  const double exponent = 3 * std::floor(std::log10(largest) / 3);
  return {std::pow(10, exponent), fmt::format("{} in 10^{{{:.0f}}}", label, exponent)};
}

/// The units of the file, which are not known.
PorkchopAxes plain_axes(const orbit::Porkchop& grid) {
  PorkchopAxes axes{.heading = "Excess speeds by departure and arrival"};
  double latest = 0, least = HUGE_VAL;
  for (const auto* times : {&grid.departures, &grid.arrivals}) {
    for (const double t : *times) latest = std::max(latest, std::abs(t));
  }
  for (const orbit::PorkchopCell& cell : grid.cells) least = std::min(least, cell.v_departure);
  std::tie(axes.time, axes.departure) = short_unit(latest, axes.departure);
  axes.arrival = short_unit(latest, axes.arrival).second;
  std::tie(axes.speed_unit, axes.speed) = short_unit(4 * least, axes.speed);
  return axes;
}

/// What pictures of this command end with. A file without it is never overwritten.
constexpr std::string_view drawn_here = "<!-- drawn by rbf_inverse porkchop --plot -->\n";

/// Where the picture goes: <name of the TOML file>.svg in the current folder.
std::filesystem::path picture_of(const Words& words) {
  return (words.file == "-" ? "porkchop" : std::filesystem::path(words.file).stem().string()) + ".svg";
}

/// Everything about a picture that can be refused before there are numbers.
void check_plot(const Words& words, const orbit::PorkchopProblem& p) {
  if (!words.shard.empty())
    throw InputError(fmt::format("--shard {}: a part is not drawn; leave out --plot", words.shard));
  if (p.departures.count < 4 || p.arrivals.count < 4)
    throw InputError(fmt::format("--grid {}: --plot needs 4x4 or more", words.grid));
  for (const auto& [name, window] : {std::pair("departures", p.departures), {"arrivals", p.arrivals}}) {
    if (!(window.first < window.last))
      throw InputError(fmt::format("{}: --plot needs a window of {} that has a width", words.file, name));
  }
  const std::filesystem::path picture = picture_of(words);
  std::error_code none;
  if (!std::filesystem::exists(std::filesystem::symlink_status(picture, none))) return;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(picture, none)) ||
      !scene::read_whole(picture).ends_with(drawn_here))
    throw InputError(
        fmt::format("--plot: {} is there and is no picture of this command, which overwrites nothing else; "
                    "move it, or run in "
                    "another folder",
                    picture.string()));
}

/// Draws the picture. The numbers have been printed: a failure leaves them where they are.
void plot(const Words& words, const orbit::Porkchop& grid) {
  try {
    const scene::Figure figure = porkchop_map(grid, plain_axes(grid));
    const Scratch folder;
    scene::write_whole(folder.path() / "data.csv", figure.data.csv());
    scene::write_whole(folder.path() / "map.gp", scene::gnuplot_script(figure, "data.csv"));
    scene::put_style(folder.path());
    scene::write_whole(picture_of(words), scene::draw(folder.path(), "map.gp").append(drawn_here));
  } catch (const Failure& failure) {
    throw Failure(fmt::format("porkchop: all numbers are written, but {} is not drawn: {}",
                              picture_of(words).string(), failure.what()));
  }
}

void porkchop(const Words& words) {
  orbit::PorkchopProblem p = read_porkchop(scene::read_whole(words.file), words.file);
  const auto [rows, columns] = halves("--grid", words.grid, 'x');
  p.departures.count = scene::typed_whole("--grid", rows, 1, 1'000'000);
  p.arrivals.count = scene::typed_whole("--grid", columns, 1, 1'000'000);
  orbit::PorkchopWork work{.threads = scene::typed_whole("--threads", words.threads, 0, 1024)};
  if (!words.shard.empty()) {
    const auto [shard, shards] = halves("--shard", words.shard, '/');
    work.shards = scene::typed_whole("--shard", shards, 1, 1'000'000);
    work.shard = scene::typed_whole("--shard", shard, 1, work.shards);
  }
  if (words.plot) check_plot(words, p);
  orbit::Porkchop grid;
  try {
    grid = orbit::porkchop(p, work);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", words.file, error.what()));
  }
  if (!grid.status.ok()) throw Failure(grid.status);
  scene::print_result(words.shard.empty() ? porkchop_csv(grid) : porkchop_part_csv(p, work, grid));
  if (words.plot) plot(words, grid);
}

std::string merge(const Words& words) {
  std::vector<PorkchopPart> parts;
  for (const std::string& name : words.parts) parts.push_back({scene::read_whole(name), name});
  return merged(parts);
}

CLI::App* add(CLI::App& app, const char* name, const char* help, const std::shared_ptr<Words>& words,
              std::string (*work)(const Words&)) {
  CLI::App* command = app.add_subcommand(name, help);
  command->callback([words, work] { scene::print_result(work(*words)); });
  return command;
}

void add_lambert_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* command =
      add(app, "lambert",
          "The orbit from one position to another in a given time, as CSV: "
          "vx0,vy0,vz0,vx1,vy1,vz1,miss_m. The departure is integrated by another method: a miss "
          "beyond a millionth of the distance is a failure",
          words, lambert);
  command->add_option("--from", words->from, "x,y,z from the centre, in any consistent units")->required();
  command->add_option("--to", words->to, "x,y,z of the arrival")->required();
  command->add_option("--time", words->time, "of flight, positive")->required();
  command->add_option("--mu", words->mu, "gravitational parameter; the Earth's 3.986004418e14 without it");
  command->add_flag("--long-way", words->long_way, "by more than 180 degrees");
  command->add_option("--revolutions", words->revolutions, "whole ones before the arrival")
      ->capture_default_str();
  command->add_option("--branch", words->branch,
                      "of one revolution or more: low (smaller semi-major axis) or high");
  command->add_option("--plane", words->plane,
                      "nx,ny,nz: the normal of the plane, for opposite positions alone");
  command->add_option("--zonal", words->zonal, "J2 of the centre, the axis along z");
  command->add_option("--radius", words->radius, "that J2 refers to");
  command
      ->add_option("--method", words->method, "izzo, or collocation (81 nodes, polynomials, the short way)")
      ->capture_default_str();
}

void add_porkchop_commands(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("porkchop",
                         "Excess speeds of transfers between two orbits over a grid of times, as CSV: "
                         "departure,arrival,v_departure,v_arrival,revolutions");
  command->callback([words] { porkchop(*words); });
  command->footer(porkchop_keys());
  command
      ->add_option("orbits", words->file,
                   "TOML: mu, [from], [to], [departures], [arrivals]; - is standard input")
      ->required();
  command->add_option("--grid", words->grid, "NxM: departures and arrivals")->required();
  command->add_option("--shard", words->shard, "i/n: the i-th of n disjoint parts, for merge");
  command->add_option("--threads", words->threads, "how many; 0: one a processor")->capture_default_str();
  command->add_flag(
      "--plot", words->plot,
      "also draws the grid: <name of the TOML file>.svg in this folder, over an older picture alone");
  const auto others = std::make_shared<Words>();
  add(app, "merge", "Joins all shards of one grid, given in any order, to what one run writes", others, merge)
      ->add_option("parts", others->parts, "files written by porkchop --shard")
      ->required();
}

}  // namespace

void add_lambert_commands(CLI::App& app) {
  add_lambert_command(app);
  add_porkchop_commands(app);
}

}  // namespace nlmech::chapters::rbf_inverse
