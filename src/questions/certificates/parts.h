/// @file
/// The parts of the section: certificates, with faults planted in sound data, and the preflight of every mesh.
#pragma once

#include "geometry/measures/mesh_facts.h"
#include "questions/core/section_tools.h"

namespace meshfolio::certificates {

inline constexpr report::Words words("certificates");

/// Counts of what add_certificates() adds.
struct Certificates {
    Names meshes;       // with a spectrum
    int complete = 0;   // spectra proved complete
    int faults = 0, missed = 0;
};
/// Certifies the spectra and operators of the meshes, tries every planted fault, and adds tables, checks and paragraphs.
Certificates add_certificates(report::Section& section, const MeshLibrary& library, const QuestionSettings& settings,
                              const Progress& progress);

/// A mesh as its file has it, never a decimated copy.
struct Inspected : OnMesh {
    MeshFacts facts;

    const Preflight& counts() const { return facts.counts; }
    bool is_sound() const;   // without any of defect_list()
};

/// Inspects the meshes of the settings, else the user's own, else one for each role, each file once, and enters them into the section. The
/// mesh of a role that is unusable becomes a failed check.
/// @throws InputError for an unusable mesh of the settings or the user, and if no role can be used
std::vector<Inspected> inspected_meshes(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                        report::Section& section);
/// Adds the part about these meshes: their properties, their defects, the questions affected, and the repairs.
void add_preflight(report::Section& section, const std::vector<Inspected>& meshes);

}   // namespace meshfolio::certificates
