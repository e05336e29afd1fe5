/// @file
/// The whole of results.json, described as in json_fields.h.
#pragma once

#include "report/json/json_fields.h"

namespace meshfolio::report {

/// Raised whenever a reader of the earlier one would misread what is written; keys that are added do not raise it.
inline constexpr int schema_version = 3;

struct MeshDigest {
    std::string file, sha256;
    bool operator==(const MeshDigest&) const = default;
};
/// Every input mesh once, by name and content.
std::vector<MeshDigest> input_meshes(const std::vector<Section>& sections);

struct ProvenanceEntry {
    Provenance provenance;
    std::vector<MeshDigest> inputs;
};

struct ReportEntry {
    int version = schema_version;
    std::string title, author, course;
    ProvenanceEntry provenance;
    std::optional<FigureEntry> cover;
    std::vector<SectionEntry> questions, supporting;
    bool with_timings = true;
    std::vector<Timing> timings;
};

template <class Fields>
void describe(Fields& fields, part_of<MeshDigest> auto& mesh) {
    fields("file", mesh.file);
    fields("sha256", mesh.sha256);
}

template <class Fields>
void describe(Fields& fields, part_of<ProvenanceEntry> auto& entry) {
    auto& provenance = entry.provenance;
    fields.derived("program", [] { return "meshfolio"; });
    fields("version", provenance.version);
    fields("commit", provenance.commit);
    fields("compiler", provenance.compiler);
    fields("build_type", provenance.build_type);
    fields("libraries", provenance.libraries);
    fields("settings", provenance.settings);
    fields("seed", provenance.seed, "64 bits without sign");
    fields("inputs", entry.inputs);
}

template <class Fields>
void describe(Fields& fields, part_of<ReportEntry> auto& report) {
    fields("schema_version", report.version, {"", schema_version, schema_version});
    fields("title", report.title);
    fields("author", report.author);
    fields("course", report.course);
    fields("provenance", report.provenance);
    fields.optional("cover", report.cover, "the picture of the first page");
    fields("questions", report.questions);
    fields("supporting", report.supporting);
    fields.if_there("timings", report.timings, report.with_timings, timings_note);
}

}   // namespace meshfolio::report
