// Certificates: what the computations rest on, proved or refuted; and preflight, what the meshes are.
#include "questions/certificates/parts.h"

namespace meshfolio::certificates {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("certificates")};
    report::Section& section = answer.section;
    const std::vector<Inspected> inspected = inspected_meshes(library, settings, progress, section);
    const Certificates certificates = add_certificates(section, library, settings, progress);
    add_preflight(section, inspected);

    section.extent =
        words.line("extent", "meshes"_a = inspected.size(), "spectra"_a = listed(certificates.meshes), "faults"_a = certificates.faults);
    const auto spectra = std::ssize(certificates.meshes);
    const auto flawed = std::ssize(inspected) - std::ranges::count_if(inspected, &Inspected::is_sound);
    section.answer =
        words.say("answer", "spectra"_a = spectra, "complete"_a = certificates.complete,
                  "all_complete"_a = certificates.complete == spectra, "faults"_a = certificates.faults, "missed"_a = certificates.missed,
                  "flawed"_a = flawed, "meshes"_a = inspected.size(), "several"_a = inspected.size() > 1);
    return answer;
}

extern const Chapter chapter{
    .id = "certificates",
    .code = {{"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"first_variation_error", "src/geometry/measures/mesh_laws.cpp"},
             {"planted_faults", "src/questions/certificates/planted_faults.cpp"},
             {"prepare_mesh", "src/mesh/mesh_checks.cpp"},
             {"consistent_orientation", "src/mesh/orientation.cpp"},
             {"defect_list", "src/questions/bench/defects.cpp"},
             {"change_when_moved", "src/geometry/measures/mesh_facts.cpp"},
             {"answer", "src/questions/certificates/chapter.cpp"}},
    .roles = {"plane", "lilium", "armadillo", "plane_ns", "fandisk_ns", "cube", "cube8", "sphere", "ellipsoid", "torus", "bumpy_cube",
              "saddle", "fandisk"},
    .cost = {.cpu = {{0.6, 0, 12}, {0.5, 3.2}}, .memory = {{2, 125}, {3, 55}}, .whole_cpu = {0, 1.2}},
    .answer = answer,
    .batch = {{"edges", "connectivity-edges"},
              {"components", "connectivity-components"},
              {"boundary_loops", "connectivity-boundary-loops"},
              {"euler_characteristic", "connectivity-chi"},
              {"genus", "connectivity-genus"},
              {"manifold", "connectivity-manifold"},
              {"orientation", "connectivity-orientation"},
              {"defects", "defects"}},
    .never_left_out = true,
    .verifies_program = true,
};

}   // namespace meshfolio::certificates
