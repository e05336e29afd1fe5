/// @file
/// Faults planted in sound data. A named check must fail with each and pass without it: a check that cannot fail proves nothing.
#pragma once

#include <functional>

#include "questions/bench/law_checks.h"
#include "questions/core/section_tools.h"

namespace meshfolio::certificates {

/// The data of all checks, and two claims about the spectrum. Each part can be damaged on its own.
struct Specimen {
    TriangleMesh mesh;
    SurfaceClaims claims;
    LaplaceBeltrami laplacian;
    Vector angle_deficits;   // [rad]
    Spectrum spectrum;
    double complete_shift = 0;   // claim: exactly modes_known eigenvalues lie below, none near [1/length²]
    int modes_known = 0;
    double stable_shift = 0;   // claim: it lies above μ_max [1/length²]
};

/// Computes the 12 smallest modes of a closed mesh and claims that are true. The 12th and 13th eigenvalue must differ.
Specimen sound_specimen(const TriangleMesh& mesh);
/// Returns the sound specimen of an ellipsoid with 642 vertices.
Specimen ellipsoid_specimen();

/// Returns the checks of law_checks.h on the specimen and the checks of its two claims.
std::vector<report::Check> checks_of(const Specimen& specimen);

struct PlantedFault {
    std::string name;    // "one face reversed"
    std::string check;   // name of the check that must fail with the fault
    std::function<void(Specimen&)> plant;
};
/// Returns all faults, each with the check that must see it.
std::vector<PlantedFault> planted_faults();

/// The checks without and with one fault.
struct FaultTrial {
    std::string fault;
    report::Check sound, faulty;   // the named check, without and with the fault
    Names also_seen_by;            // names of other checks that passed without the fault and fail with it
    bool caught() const { return sound.passed() && faulty.failed(); }   // an undecided check catches nothing
};
/// Plants a fault in a copy of the specimen and compares all checks. @param sound_checks  checks_of(specimen)
/// @throws std::logic_error if no check has the name fault.check
FaultTrial trial_of(const Specimen& specimen, const std::vector<report::Check>& sound_checks, const PlantedFault& fault);
/// Returns the trial of every one of planted_faults(), in order.
std::vector<FaultTrial> trials_of(const Specimen& specimen);

/// Returns a check that expects 1 and has measured 1 if trial.caught(), else 0.
report::Check check_of(const FaultTrial& trial);

}   // namespace meshfolio::certificates
