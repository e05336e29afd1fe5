/// @file
/// The keys of results.json. Each is described once, for the writer, the reader and the schema: `fields` is a FieldWriter, FieldReader or
/// FieldSchema (json_writer.h, json_reader.h, json_schema.cpp), and a note in the last place is for the schema.
///   fields(key, value)                      always there
///   fields.optional(key, value, fallback)   absent if the value is the fallback
///   fields.only_if(condition, key, value)   there if the condition holds
///   fields.derived(key, f)                  follows from other values: written for programs, checked by the reader
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/json/json_drawings.h"
#include "report/json/json_entries.h"

namespace meshfolio::report {

// ---- tables -------------------------------------------------------------------------------------------------------------

inline constexpr int most_digits = 17;   // a double has no more

void describe(auto& fields, part_of<Column> auto& column) {
    auto& [name, unit, digits, best, rounding, heat, filter, reference] = column;   // all fields: leaving one out does not compile
    const Column fallback;
    fields("name", name);
    fields("unit", unit);
    fields("digits", digits, {"significant, for people", 1, most_digits});
    fields.optional("best", best, fallback.best, "which value is marked");
    fields.optional("rounding", rounding, fallback.rounding, "of people's digits");
    fields.optional("heat", heat, "cells are shaded between these");
    fields.optional("filter", filter, fallback.filter, "readers may choose one of its values");
    fields.optional("reference", reference, fallback.reference, "its texts are ids");
}

void describe(auto& fields, part_of<ColumnEntry> auto& entry) {
    fields("id", entry.id);
    describe(fields, entry.column);
}

void describe(auto& fields, part_of<Table> auto& table) {
    fields("id", table.id);
    fields("caption", table.caption);
    fields.derived("file", [&] { return table_file(table.id); });
    fields.optional("sortable", table.sortable, false, "readers of the page may sort it");
    fields.optional("file_only", table.file_only, false, "for programs: no page shows it");
    std::vector<ColumnEntry> columns = column_entries(table);
    fields("columns", columns);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(table)>>) {   // the reader
        table.columns.clear();
        for (ColumnEntry& entry : columns) table.columns.push_back(std::move(entry.column));
    }
    fields("rows", table.rows);
}

// ---- parts of sections --------------------------------------------------------------------------------------------------

void describe(auto& fields, part_of<BlockEntry> auto& block) {
    fields("kind", block.kind);
    switch (block.kind) {
        case BlockEntry::Kind::heading: return fields("title", block.title);
        case BlockEntry::Kind::paragraph: return fields("text", block.text);
        case BlockEntry::Kind::list: return fields("items", block.items);
        case BlockEntry::Kind::formula: fields("name", block.name, "in formulas.json"); return fields.optional("id", block.id, {});
        default: return fields("id", block.id);
    }
}

void describe(auto& fields, part_of<Check> auto& check) {
    fields("name", check.name);
    fields("kind", check.kind);
    fields("expected", check.expected);
    fields("measured", check.measured);
    fields("tolerance", check.tolerance);
    fields("status", check.status);
    const auto passed = [&] { return check.status == Check::Status::undecided ? std::nullopt : std::optional(check.passed()); };
    fields.derived("passed", passed, "null: undecided");
    fields.optional("note", check.note, {});
}

void describe(auto& fields, part_of<CheckEntry> auto& entry) {
    fields("id", entry.id);
    describe(fields, entry.check);
}

void describe(auto& fields, part_of<ParameterEntry> auto& entry) {
    fields("id", entry.id);
    fields("name", entry.name, "in `parameters`");
    fields("value", entry.value, "a number, a list of numbers, or words");
    fields("unit", entry.unit);
}

void describe(auto& fields, part_of<Input> auto& input) {
    fields("role", input.role);
    fields("asked", input.asked, "path in the assignment; empty: not asked for");
    fields("file", input.file);
    fields("stand_in", input.stand_in, "a bundled mesh in place of the one asked for");
    fields("sha256", input.sha256);
    fields("vertices", input.vertices, {"", 0});
    fields("triangles", input.triangles, {"", 0});
}

void describe(auto& fields, part_of<CodeReference> auto& code) {
    fields("function", code.function);
    fields("file", code.file);
    fields("purpose", code.purpose);
    fields.optional("line", code.line, 0, {"of its definition in src.txt; absent where src.txt has none", 1});
}

void describe(auto& fields, part_of<Timing> auto& timing) {
    fields("what", timing.what);
    fields("seconds", timing.seconds);
}

inline constexpr const char* timings_note = "absent from a report without timings; the only part that differs from run to run";

void describe(auto& fields, part_of<SectionEntry> auto& entry) {
    auto& section = entry.section;
    fields("id", section.id);
    fields("title", section.title);
    fields("asked", section.asked);
    fields.optional("number", section.number, {}, "of a question, in place of that of its id");
    fields.optional("points", section.points, 0, "that the question gives");
    fields.optional("intro", section.intro, {}, "Markdown of the teacher, in place of `asked`");
    fields("status", section.status);
    fields("extent", section.extent);
    fields.optional("answer", section.answer, {}, "in one sentence");
    fields.only_if(section.status == Status::failed, "failure", section.failure, "why, for status failed");
    fields("inputs", section.inputs);
    fields("parameters", entry.parameters, "the printed text of each");
    fields("parameter_values", entry.parameter_values, "the same, in their order, for programs");
    fields("code", section.code);
    fields("blocks", entry.blocks, "the order of reading: each list below is used from its beginning");
    fields.optional("appendix_from", section.appendix_from, -1,
                    {"number of blocks in the report; the appendix has the others; absent: all are in the report", 0});
    fields("tables", entry.tables);
    fields("plots", entry.plots);
    fields("maps", entry.maps, "values over a plane, in panels on common axes");
    fields.optional("diagrams", entry.diagrams, {}, "the geometry behind a formula, y upwards; absent where there are none");
    fields("figures", entry.figures);
    fields(
        "checks", entry.checks,
        "near: |measured - expected| <= tolerance; at_most: measured <= expected + tolerance; at_least: measured >= expected - tolerance; "
        "undecided: the number decides nothing, for the reason in the note; no failure");
    fields("warnings", section.warnings);
    fields("output_meshes", section.output_meshes, file_note());
    fields.optional("timings", entry.timings, timings_note);
}

void describe(auto& fields, part_of<MeshDigest> auto& mesh) {
    fields("file", mesh.file);
    fields("sha256", mesh.sha256);
}

void describe(auto& fields, part_of<ProvenanceEntry> auto& entry) {
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

void describe(auto& fields, part_of<OwnPage> auto& page) {
    fields("title", page.title);
    fields("text", page.text, "Markdown");
    fields("before", page.before, "id of the question that follows; empty: after the last");
}

void describe(auto& fields, part_of<ReportEntry> auto& report) {
    fields("schema_version", report.version, {"", schema_version, schema_version});
    fields("title", report.title);
    fields("author", report.author);
    fields("course", report.course);
    fields.optional("pages", report.pages, {}, "of the user's own text, between the questions");
    fields("provenance", report.provenance);
    fields("questions", report.questions);
    fields("supporting", report.supporting);
    fields.optional("timings", report.timings, timings_note);
}

}   // namespace meshfolio::report
