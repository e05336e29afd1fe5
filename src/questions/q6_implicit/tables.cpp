#include <algorithm>

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
        .column("energy, implicit", {.unit = "of input"}, &SmoothingCell::implicit_energy)
        .column("energy, explicit", {.unit = "of input"}, [](auto& c) { return cell_of(c.explicit_energy, c.has_explicit()); })
        .column("moved, implicit (rms)", {.unit = "% of box"}, [&](auto& c) { return percent * vertex_rms(X, c.implicit_X); })
        .column("gap", {.unit = "% of box"}, gap)
        .column("volume, implicit", {.unit = "% of input", .digits = 4}, [](auto& c) { return cell_of(100 * c.volume_ratio); })
        .column("inverted faces, implicit", {.digits = 6}, [](auto& c) { return cell_of(c.inverted_faces, !c.collapsed()); })
        .column("explicit blew up in", {.unit = "iteration", .digits = 6},
                [](auto& c) { return cell_of(c.explicit_blow_up, c.explicit_blow_up > 0); });
}

report::Table cost_table(const Studies& studies) {
    const bool reached = std::ranges::all_of(studies, [](const ImplicitStudy& s) { return s.cost.reached(); });
    return table("q6_cost", words.line("cost", "unreached"_a = reached ? "" : " " + words.line("cost.unreached")), studies)
        .column("mesh", &ImplicitStudy::name)
        .column("energy reached", {.unit = "of input"}, [](auto& s) { return s.cost.energy; })
        .column("implicit λ/λ_crit", [](auto& s) { return s.cost.implicit_lambda / s.subject.critical; })
        .column("implicit steps", {.digits = 5}, [](auto& s) { return s.cost.implicit_steps; })
        .column("explicit steps", {.digits = 5}, [](auto& s) { return cell_of(s.cost.explicit_steps, s.cost.reached()); })
        .column("nonzeros of factor", {.digits = 7}, [](auto& s) { return s.cost.factor_nonzeros; })
        .column("nonzeros of C", {.digits = 7}, [](auto& s) { return s.cost.operator_nonzeros; })
        .column("implicit", {.unit = "multiply–adds"}, [](auto& s) { return s.cost.implicit_operations; })
        .column("explicit", {.unit = "multiply–adds"}, [](auto& s) { return cell_of(s.cost.explicit_operations, s.cost.reached()); });
}

}   // namespace meshfolio::q6_implicit
