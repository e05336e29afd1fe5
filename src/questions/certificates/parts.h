/// @file
/// The parts of the section: certificates, faults planted in sound data, and the preflight of every mesh. Each fault must be seen by a
/// named check that passes without it: a check that cannot fail proves nothing.
#pragma once

#include "questions/bench/law_checks.h"
#include "questions/certificates/defects.h"
#include "questions/core/section_tools.h"

namespace meshfolio::certificates {

inline constexpr report::Words words("certificates");

/// All that the checks look at, and two claims about the spectrum. Each part can be damaged on its own.
struct Specimen {
    TriangleMesh mesh;
    SurfaceClaims claims;
    LaplaceBeltrami laplacian;
    Vector angle_deficits;   // [rad]
    Spectrum spectrum;
    double complete_shift = 0;   // all eigenvalues below this σ are claimed to be in the spectrum, none near it [1/length²]
    int modes_known = 0;         // how many
    double stable_shift = 0;     // claimed to lie above μ_max [1/length²]
};

/// The 12 smallest modes of a closed mesh with its claims, all sound. Its 12th and 13th eigenvalue must differ.
Specimen sound_specimen(const TriangleMesh& mesh);
/// Of an ellipsoid of 642 vertices.
Specimen ellipsoid_specimen();

/// Every check of law_checks.h and the two claims.
std::vector<report::Check> checks_of(const Specimen& specimen);

struct PlantedFault {
    std::string name;    // "one face reversed"
    std::string check;   // name of the check that is to see it
    std::function<void(Specimen&)> plant;
};
std::vector<PlantedFault> planted_faults();

/// What the checks said with a fault.
struct FaultTrial {
    std::string fault;
    report::Check sound, faulty;   // the named check, without and with it; undecided is not caught
    Names also_seen_by;            // names of other checks that passed without it and fail with it
    bool caught() const { return sound.passed() && faulty.failed(); }
};
/// @param sound_checks  checks_of(specimen)
/// @throws std::logic_error if no check has the name
FaultTrial trial_of(const Specimen& specimen, const std::vector<report::Check>& sound_checks, const PlantedFault& fault);
std::vector<FaultTrial> trials_of(const Specimen& specimen);

/// "planted fault 'one face reversed' is caught by '…'": 1 caught, 0 not.
report::Check check_of(const FaultTrial& trial);

/// One mesh with its operator, its smallest modes and what was measured on them.
struct Certified : OnMesh {
    LaplaceBeltrami laplacian;
    Vector angle_deficits;   // [rad]
    int without_area = 0;    // triangles
    SpectrumCertificate certificate;
    int modes = 0;

    SurfaceClaims claims() const {
        const Preflight& p = source->preflight();
        return {p.manifold(), p.orientable, p.encloses_volume(), p.euler_characteristic};
    }
};

/// A mesh as its file has it, never a copy with fewer vertices.
struct Inspected : OnMesh {
    MeshFacts facts;

    const Preflight& counts() const { return facts.counts; }
    bool is_sound() const { return defects_of(facts).empty(); }
};

/// Inspects the meshes of the settings, else the user's own, else one a role, each once, and enters them. An unreadable one becomes a
/// failed check.
/// @throws InputError if none can be used
std::vector<Inspected> inspected_meshes(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                        report::Section& section);
/// Adds the part on these meshes: what they are, what is wrong with them, what that affects and what was done.
void add_preflight(report::Section& section, const std::vector<Inspected>& meshes);

}   // namespace meshfolio::certificates
