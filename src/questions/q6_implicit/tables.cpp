#include <algorithm>

#include "base/number_text.h"
#include "questions/core/study_list.h"
#include "questions/core/table.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

report::Table grid_table(const ImplicitStudy& study) {
    const double percent = 100 / study.subject.diagonal;
    const Positions& X = study.subject.mesh().X;
    const auto gap = [=](const SmoothingCell& c) {
        return c.has_explicit() ? cell_of(percent * vertex_rms(c.implicit_X, c.explicit_X)) : report::Cell();
    };
    return table(id_of("q6", study.name(), "grid"), words.line("grid", "mesh"_a = study.name()), study.grid)
        .column("λ", {.unit = "length²"}, &SmoothingCell::lambda)
        .column("λ/λ_crit", [&](auto& c) { return c.lambda / study.subject.critical; })
        .column("iterations", {.digits = 4}, &SmoothingCell::iterations)
        .column("energy, implicit", {.unit = "of input"}, [](auto& c) { return cell_of(c.implicit_energy, !c.collapsed()); })
        .column("energy, explicit", {.unit = "of input"}, [](auto& c) { return cell_of(c.explicit_energy, c.has_explicit()); })
        .column("moved, implicit (rms)", {.unit = "% of box"}, [&](auto& c) { return percent * vertex_rms(X, c.implicit_X); })
        .column("gap", {.unit = "% of box"}, gap)
        .column("volume, implicit", {.unit = "% of input", .digits = 4}, [](auto& c) { return cell_of(100 * c.volume_ratio); })
        .column("inverted faces, implicit", {.digits = 6}, [](auto& c) { return cell_of(c.inverted_faces, !c.collapsed()); })
        .column("explicit blew up in", {.unit = "iteration", .digits = 6},
                [](auto& c) { return cell_of(c.explicit_blow_up, c.explicit_blow_up > 0); });
}

report::Table cost_table(const Studies& studies) {
    const auto rows = parts_within(studies, &ImplicitStudy::costs);
    using Row = Within<ImplicitStudy, SmoothingCost>;
    const auto cell = [](const Row& r) -> const SmoothingCell& { return r.part.cell; };
    const bool reached = std::ranges::all_of(rows, [](const Row& r) { return r.part.reached(); });
    return table("q6_cost", words.line("cost") + (reached ? "" : " " + words.line("cost.unreached")), rows)
        .column("mesh", [](auto& r) { return r.whole.name(); })
        .column("amount", [](auto& r) { return words.line(r.part.recommended ? "amount.good" : "amount.far"); })
        .column("λ/λ_crit", [&](auto& r) { return cell(r).lambda / r.whole.subject.critical; })
        .column("t", {.digits = 4}, [&](auto& r) { return cell(r).iterations; })
        .column("λt", {.unit = "h̄²", .digits = 2},
                [&](auto& r) { return cell(r).time() / (r.whole.subject.mean_edge * r.whole.subject.mean_edge); })
        .column("energy", {.unit = "% of input"}, [&](auto& r) { return 100 * cell(r).implicit_energy; })
        .column("size", {.unit = "% of input"}, [&](auto& r) { return 100 * cell(r).kept; })
        .column("faces turned", {.digits = 6}, [&](auto& r) { return cell(r).inverted_faces; })
        .column("face angle", {.unit = "°", .digits = 2}, [](auto& r) { return r.part.roughness; })
        .column("face angle, explicit", {.unit = "°", .digits = 2}, [](auto& r) { return cell_of(r.part.explicit_roughness); })
        .column("explicit steps", {.digits = 5}, [](auto& r) { return cell_of(r.part.explicit_steps, r.part.reached()); })
        .column("price, explicit", {.unit = "× implicit", .digits = 2}, [](auto& r) { return cell_of(r.part.ratio()); });
}

}   // namespace meshfolio::q6_implicit
