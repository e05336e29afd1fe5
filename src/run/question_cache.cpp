#include "run/question_cache.h"

#include <tbb/parallel_for.h>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "output/publish/folder_system.h"
#include "report/json/json_reader.h"
#include "report/json/read_json.h"
#include "report/words.h"
#include "report/writers.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/provenance.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

constexpr std::uintmax_t megabyte = 1'000'000;              // as `doctor` and `cache` tell sizes
constexpr std::uintmax_t default_limit = 2048 * megabyte;   // some ten full reports

constexpr const char* form = "meshfolio answer 2";   // of what is stored: another form, another key

json json_of(const std::vector<MeshLookup>& lookups) {
    json list = json::array();
    for (const MeshLookup& l : lookups) list.push_back({static_cast<int>(l.by), l.name, l.path.string(), l.stand_in});
    return list;
}

std::vector<MeshLookup> lookups_of(const json& list) {
    std::vector<MeshLookup> lookups;
    for (const json& l : list)
        lookups.push_back({static_cast<MeshLookup::By>(l.at(0).get<int>()), l.at(1), fs::path(l.at(2).get<std::string>()), l.at(3)});
    return lookups;
}

// ---- figures: the bytes that results.json does not hold, in the order in which it names what they are of ------------------

json json_of(const report::DrawnFigure& figure, output::ResultCache& store) {
    json lengths = json::array(), models = json::array();
    std::string jpegs;   // one after another: a blob a picture would be a file each
    for (const report::DrawnPanel& panel : figure.panels) {
        for (const report::DrawnPicture& picture : panel.pictures) {
            lengths.push_back(picture.jpeg.size());
            jpegs += picture.jpeg;
        }
    }
    for (const report::DrawnModel& m : figure.models) models.push_back(store.keep(m.glb));
    return {{"jpegs", store.keep(jpegs)}, {"lengths", lengths}, {"models", models}};
}

std::string bytes_of(const json& digest, output::ResultCache& store) {
    auto bytes = store.bytes_of(digest.get<std::string>());
    if (!bytes) throw InputError({"cache"}, "has lost a file");
    return std::move(*bytes);
}

void restore(report::DrawnFigure& figure, const json& stored, output::ResultCache& store) {
    const std::string jpegs = bytes_of(stored.at("jpegs"), store);
    std::size_t at = 0, picture_number = 0;
    for (report::DrawnPanel& panel : figure.panels) {
        for (report::DrawnPicture& picture : panel.pictures) {
            const auto length = stored.at("lengths").at(picture_number++).get<std::size_t>();
            if (length > jpegs.size() - at) throw InputError({"cache"}, "has lost a picture");
            picture.jpeg = jpegs.substr(at, length);
            at += length;
        }
    }
    for (std::size_t m = 0; m < figure.models.size(); ++m) figure.models[m].glb = bytes_of(stored.at("models").at(m), store);
}

/// Puts every file in its place, or none.
bool place_files(const std::map<std::string, std::string>& digests, output::ResultCache& store, const fs::path& folder) {
    std::vector<std::pair<std::string, std::string>> files(digests.begin(), digests.end());
    for (const auto& [file, digest] : files) output::make_folder((folder / file).parent_path());
    std::vector<char> placed(files.size(), false);
    tbb::parallel_for(std::size_t{0}, files.size(),
                      [&](std::size_t i) { placed[i] = store.place(files[i].second, folder / files[i].first); });
    if (std::find(placed.begin(), placed.end(), false) == placed.end()) return true;
    for (std::size_t i = 0; i < files.size(); ++i) {
        std::error_code ignored;
        if (placed[i]) fs::remove(folder / files[i].first, ignored);
    }
    return false;
}

}   // namespace

std::set<std::string> files_of(const report::Section& section, const report::DrawnFigures& figures) {
    std::set<std::string> files(section.output_meshes.begin(), section.output_meshes.end());
    const auto add_drawing = [&](const std::string& id) {
        files.insert("tables/" + id + ".csv");
        files.insert("images/" + id + ".svg");
    };
    for (const report::Block& block : section.blocks) {
        if (const auto* table = std::get_if<report::Table>(&block)) files.insert("tables/" + table->id + ".csv");
        if (const auto* plot = std::get_if<report::Plot>(&block)) add_drawing(plot->id);
        if (const auto* map = std::get_if<report::Map>(&block)) add_drawing(map->id);
        if (const auto* diagram = std::get_if<report::Diagram>(&block)) files.insert("images/" + diagram->id + ".svg");
    }
    for (const auto& [id, figure] : figures) {
        files.insert(figure.sheet);
        for (const report::DrawnPanel& panel : figure.panels) {
            for (const report::DrawnPicture& picture : panel.pictures)
                if (!picture.file.empty()) files.insert(picture.file);
        }
        for (const report::DrawnModel& model : figure.models) files.insert(model.file);
    }
    return files;
}

QuestionCache::QuestionCache(output::ResultCache& store, const ReportSettings& settings, const MeshLibrary& meshes, fs::path folder)
    : store_(store), settings_(settings), meshes_(meshes), folder_(std::move(folder)) {}

std::string QuestionCache::question_key(const std::string& question, bool with_meshes) const {
    output::KeyMaker key;
    key.add(form).add(program_identity()).add(report::words_identity()).add(question);
    for (const std::string& word : identity_of(settings_, question, with_meshes)) key.add(word);
    return key.key();
}

std::string QuestionCache::answer_key(const std::string& question, const std::vector<MeshLookup>& lookups) const {
    output::KeyMaker key;
    key.add(question_key(question, !lookups.empty()));
    for (const MeshLookup& lookup : lookups) {   // a path need not be UTF-8
        key.add(std::to_string(static_cast<int>(lookup.by))).add(lookup.name).add(lookup.path.string()).add(lookup.stand_in);
        key.add(meshes_.identity_of(lookup, settings_.base));
    }
    return key.key();
}

std::optional<StoredAnswer> QuestionCache::find(const std::string& question) const try {
    for (const bool with_meshes : {false, true}) {
        const auto lookups = store_.get(question_key(question, with_meshes));
        if (lookups) return read(answer_key(question, lookups_of(json::parse(*lookups))));
    }
    return {};
} catch (const json::exception&) {   // written by another version
    return {};
}

std::optional<StoredAnswer> QuestionCache::read(const std::string& key) const try {
    const auto bytes = store_.get(key);
    if (!bytes) return {};
    const json stored = json::parse(*bytes);
    StoredAnswer answer;
    const std::string text = bytes_of(stored.at("section"), store_);
    report::ReadReport read = report::read_json(text, "cache");
    answer.section = std::move(read.document.sections.at(0));
    answer.figures = std::move(read.figures);
    for (auto& [id, figure] : answer.figures) restore(figure, stored.at("figures").at(id), store_);
    answer.digests = stored.at("files").get<std::map<std::string, std::string>>();
    for (const auto& [file, digest] : answer.digests) report::require_inner_path(file, {});
    if (!place_files(answer.digests, store_, folder_)) return {};
    return answer;
} catch (const json::exception&) {
    return {};
} catch (const InputError&) {
    return {};
} catch (const report::JsonProblem&) {   // a path that leaves the report's folder
    return {};
}

std::map<std::string, std::string> QuestionCache::keep(const report::Section& section, const report::DrawnFigures& figures,
                                                       const std::vector<MeshLookup>& lookups) const try {
    auto digests = write(answer_key(section.id, lookups), section, figures);
    store_.put(question_key(section.id, !lookups.empty()), json_of(lookups).dump());
    return digests;
} catch (const json::exception&) {   // a name that is no UTF-8: not kept
    return {};
}

std::map<std::string, std::string> QuestionCache::write(const std::string& key, const report::Section& section,
                                                        const report::DrawnFigures& figures) const {
    std::map<std::string, std::string> digests;
    for (const std::string& file : files_of(section, figures)) digests[file];
    std::vector<std::pair<const std::string, std::string>*> slots;
    for (auto& slot : digests) slots.push_back(&slot);
    tbb::parallel_for(std::size_t{0}, slots.size(),
                      [&](std::size_t i) { slots[i]->second = store_.keep(read_file(folder_ / slots[i]->first)); });
    report::Document document;
    document.sections = {section};
    document.sections[0].timings.clear();   // of that run
    const std::string text = report::write_json(document, figures);
    if (text.find("\uFFFD") != std::string::npos) return {};   // words that are no UTF-8 would not come back
    json stored = {{"section", store_.keep(text)}, {"files", digests}, {"figures", json::object()}};
    for (const auto& [id, figure] : figures) stored["figures"][id] = json_of(figure, store_);
    store_.put(key, stored.dump());
    return digests;
}

std::uintmax_t cache_limit() {
    const std::string given = environment("MESHFOLIO_CACHE_LIMIT");
    if (given.empty()) return default_limit;
    return static_cast<std::uintmax_t>(integer_between("MESHFOLIO_CACHE_LIMIT", given, 1, 1000000)) * megabyte;
}

std::unique_ptr<output::ResultCache> usable_cache() {
    const std::uintmax_t limit = cache_limit();
    const auto folder = output::default_cache_folder();
    if (!folder) {
        warn("no cache is used: neither XDG_CACHE_HOME nor HOME names a folder");
        return nullptr;
    }
    try {
        return std::make_unique<output::ResultCache>(*folder, limit);
    } catch (const OutputError& error) {
        warn("no cache is used: " + std::string(error.what()));
        return nullptr;
    }
}

}   // namespace meshfolio::run
