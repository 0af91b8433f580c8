#include "nlmech/scene/publish.hpp"

#include <fmt/format.h>

#include "nlmech/scene/files.hpp"
#include "nlmech/scene/gnuplot.hpp"
#include "nlmech/scene/provenance.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

void draw_figure(const std::string& chapter, const std::string& scene, const Figure& figure,
                 const Publishing& how) {
  const std::string data = fmt::format("results/{}/{}.csv", chapter, scene);
  const auto draw_as = [&](PictureFormat format) {
    const std::string name = scene + (format == PictureFormat::svg ? ".svg" : ".png");
    const fs::path picture = how.out / "figures" / chapter / name;
    try {
      write_whole(picture, draw(data_folder() / "figures", figure.template_name, how.out, data,
                                figure.variables, format));
    } catch (const Failure& failure) {
      std::error_code ignored;
      fs::remove(picture, ignored);  // a drawing of older data beside new data would mislead
      throw Failure(fmt::format("figure {} of {} was not drawn: {}; its data are in {}", name, chapter,
                                failure.what(), (how.out / data).string()));
    }
  };
  draw_as(PictureFormat::svg);
  if (how.png) draw_as(PictureFormat::png);
}

}  // namespace

void publish(const Chapter& chapter, const Scene& scene, const Performance& performance, bool quick,
             const Publishing& how) {
  const Showing& showing = performance.showing;
  const fs::path results = how.out / "results" / chapter.name() / scene.name;
  const fs::path tables = how.out / "tables" / chapter.name() / scene.name;
  if (showing.figure) write_whole(results.string() + ".csv", showing.figure->data.csv());
  if (showing.table) {
    write_whole(tables.string() + ".csv", showing.table->csv());
    write_whole(tables.string() + ".md", showing.table->markdown());
  }
  write_whole(results.string() + ".json", provenance(chapter, scene, performance, quick));
  if (showing.figure && how.plots) draw_figure(chapter.name(), scene.name, *showing.figure, how);
}

}  // namespace nlmech::scene
