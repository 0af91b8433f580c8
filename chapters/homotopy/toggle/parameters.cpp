#include <cmath>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/frames/williams.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::parameters {
namespace {

struct Parameter {
  const char *symbol, *printed;
  double used;
  const char *unit, *remark;
};

void put(scene::Show& show) {
  const frames::Williams w;
  show.measured("elgohary/table-2.1/l/length of a member", w.length);
  show.measured("elgohary/table-2.1/EI/flexural rigidity (unit printed as lb/in^2)", w.ei);
  show.measured("elgohary/table-2.1/EA/extensional rigidity", w.ea);
  show.measured("elgohary/claim-2.3/l sin(beta) = 0.32/applied load", low_load);
  show.measured("elgohary/claim-2.3/l sin(beta) = 0.44/applied load near the limit point", near_load);
  show.measured("elgohary/claim-2.3/Table 2.5/applied load", last_load);
  const std::vector<Parameter> all = {
      {"l", "12.94 in", w.length, "in", "of a member: the loads fit it, not the half span"},
      {"EI", "9.27e3 lb/in^2", w.ei, "lb in^2", "the printed unit is one of a pressure"},
      {"EA", "1.885e6 lb", w.ea, "lb", ""}};
  show.table(all, {{"parameter", &Parameter::symbol},
                   {"printed", &Parameter::printed},
                   {"used", &Parameter::used, 6},
                   {"unit", &Parameter::unit},
                   {"remark", &Parameter::remark}});
  // EI/EA = t^2/12 for a rectangular section.
  show.near("thickness of a rectangular section with these rigidities", {std::sqrt(12 * w.ei / w.ea), "in"},
            0.2429, 1e-3, "sqrt(12 x 9.27e3/1.885e6) by hand, four digits");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "table-2.1",
           .title = "Parameters of Williams' toggle",
           .place = "Table 2.1",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::homotopy::parameters
