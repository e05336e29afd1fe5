#include "report/pdf/pdf_finish.h"

#include <algorithm>
#include <ctime>
#include <map>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFEFStreamObjectHelper.hh>
#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>
#include <qpdf/QPDFFileSpecObjectHelper.hh>
#include <qpdf/QPDFOutlineDocumentHelper.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFWriter.hh>
#include <set>

#include "base/errors.h"
#include "base/number_text.h"

namespace meshfolio::report {

namespace {

void open(QPDF& pdf, std::string_view bytes) {
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile("report.pdf", bytes.data(), bytes.size());
}

/// Adds the entries of the outline in reading order, each with its level.
void collect(const std::vector<QPDFOutlineObjectHelper>& items, int level, std::vector<std::pair<QPDFOutlineObjectHelper, int>>& all) {
    for (QPDFOutlineObjectHelper item : items) {
        all.emplace_back(item, level);
        collect(item.getKids(), level + 1, all);
    }
}

std::vector<std::pair<QPDFOutlineObjectHelper, int>> outline_of(QPDF& pdf) {
    std::vector<std::pair<QPDFOutlineObjectHelper, int>> all;
    QPDFOutlineDocumentHelper outline(pdf);
    collect(outline.getTopLevelOutlines(), 1, all);
    return all;
}

std::string without_spaces(std::string text) {
    for (const std::string_view space : {" ", "\n", "\t", "\u00a0", "\u2007", "\u2008", "\u2009", "\u202f"})
        for (std::size_t at = 0; (at = text.find(space, at)) != std::string::npos;) text.erase(at, space.size());
    return text;
}

/// True if an entry of the outline has the words of a heading. Chromium drops the space at the end of a line, and repeats words at the edge
/// of two of its drawings.
bool has_words_of(const std::string& heading, const std::string& entry) {
    const std::string letters = without_spaces(entry), words = without_spaces(heading);
    std::size_t at = 0;
    for (const char c : letters) at += at < words.size() && c == words[at] ? 1 : 0;
    return at == words.size() && letters.size() <= 2 * words.size();
}

void rewrite_outline(QPDF& pdf, const std::vector<std::string>& titles) {
    auto items = outline_of(pdf);
    if (items.size() != titles.size())
        throw EngineError("the PDF has " + std::to_string(items.size()) + " entries in its outline, the page " +
                              std::to_string(titles.size()) + " headings",
                          "print with another browser: --pdf-browser");
    for (std::size_t i = 0; i < items.size(); ++i) {
        auto& [item, level] = items[i];
        if (!has_words_of(titles[i], item.getTitle()))
            throw EngineError("the PDF has '" + printable(item.getTitle()) + "' in its outline where the page has '" +
                              printable(titles[i]) + "'");
        item.getObjectHandle().replaceKey("/Title", QPDFObjectHandle::newUnicodeString(titles[i]));
    }
    if (items.empty()) return;
    // Entries below a title that is alone at the top are shown, deeper ones folded away.
    const auto at_top = static_cast<int>(std::count_if(items.begin(), items.end(), [](const auto& item) { return item.second == 1; }));
    int below = 0;
    for (auto& [item, level] : items) {
        const int kids = static_cast<int>(item.getKids().size());
        const bool shown = level == 1 && at_top == 1;
        if (shown) below = kids;
        if (kids > 0) item.getObjectHandle().replaceKey("/Count", QPDFObjectHandle::newInteger(shown ? kids : -kids));
    }
    pdf.getRoot().getKey("/Outlines").replaceKey("/Count", QPDFObjectHandle::newInteger(at_top + below));
    pdf.getRoot().replaceKey("/PageMode", QPDFObjectHandle::newName("/UseOutlines"));
}

void describe(QPDF& pdf, const PdfDetails& details) {
    QPDFObjectHandle info = QPDFObjectHandle::newDictionary();
    const auto set = [&](const char* key, const std::string& value) {
        if (!value.empty()) info.replaceKey(key, QPDFObjectHandle::newUnicodeString(value));
    };
    set("/Title", details.title);
    set("/Author", details.author);
    set("/Creator", details.creator);
    QPDFObjectHandle before = pdf.getTrailer().getKey("/Info");
    if (before.isDictionary() && before.hasKey("/Producer")) info.replaceKey("/Producer", before.getKey("/Producer"));
    set("/CreationDate", details.date);
    set("/ModDate", details.date);
    pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(info));
    pdf.getTrailer().removeKey("/ID");   // its first half, random in some engines, would be kept
    QPDFObjectHandle root = pdf.getRoot();
    root.removeKey("/Metadata");   // XMP of some engines, with the time
    QPDFObjectHandle preferences = QPDFObjectHandle::newDictionary();
    preferences.replaceKey("/DisplayDocTitle", QPDFObjectHandle::newBool(true));
    root.replaceKey("/ViewerPreferences", preferences);
}

/// Returns the objects of an entry: several, one or none.
std::vector<QPDFObjectHandle> several(QPDFObjectHandle entry) {
    if (entry.isArray()) return entry.getArrayAsVector();
    return entry.isNull() ? std::vector<QPDFObjectHandle>{} : std::vector<QPDFObjectHandle>{entry};
}

/// Returns the elements of the structure tree in reading order.
std::vector<QPDFObjectHandle> elements_of(const QPDFObjectHandle& structure) {
    std::vector<QPDFObjectHandle> elements, open{structure};
    std::set<QPDFObjGen> seen;
    while (!open.empty()) {
        QPDFObjectHandle element = open.back();
        open.pop_back();
        if (!element.isDictionary() || (element.isIndirect() && !seen.insert(element.getObjGen()).second)) continue;
        elements.push_back(element);
        const auto kids = several(element.getKey("/K"));
        open.insert(open.end(), kids.rbegin(), kids.rend());
    }
    return elements;
}

/// Renames the cells of tables, which others refer to as their headers, in reading order: the names of engines differ from run to run.
void name_elements(QPDF& pdf) {
    QPDFObjectHandle structure = pdf.getRoot().getKey("/StructTreeRoot");
    if (!structure.isDictionary()) return;
    const std::vector<QPDFObjectHandle> elements = elements_of(structure);
    std::map<std::string, std::string> names;
    std::vector<QPDFObjectHandle> tree;
    for (QPDFObjectHandle element : elements) {
        if (!element.getKey("/ID").isString()) continue;
        const std::string number = std::to_string(names.size());
        const std::string name = "element" + std::string(8 - std::min<std::size_t>(8, number.size()), '0') + number;   // in order as text
        if (!names.emplace(element.getKey("/ID").getStringValue(), name).second) {
            element.removeKey("/ID");
            continue;
        }
        element.replaceKey("/ID", QPDFObjectHandle::newString(name));
        tree.insert(tree.end(), {QPDFObjectHandle::newString(name), element});
    }
    for (QPDFObjectHandle element : elements) {
        for (QPDFObjectHandle attributes : several(element.getKey("/A"))) {
            if (!attributes.isDictionary() || !attributes.getKey("/Headers").isArray()) continue;
            std::vector<QPDFObjectHandle> headers;
            for (QPDFObjectHandle header : attributes.getKey("/Headers").getArrayAsVector()) {
                const auto name = header.isString() ? names.find(header.getStringValue()) : names.end();
                if (name != names.end()) headers.push_back(QPDFObjectHandle::newString(name->second));
            }
            attributes.replaceKey("/Headers", QPDFObjectHandle::newArray(headers));
        }
    }
    structure.removeKey("/IDTree");
    if (tree.empty()) return;
    QPDFObjectHandle names_of_all = QPDFObjectHandle::newDictionary();
    names_of_all.replaceKey("/Names", QPDFObjectHandle::newArray(tree));
    structure.replaceKey("/IDTree", pdf.makeIndirectObject(names_of_all));
}

void attach(QPDF& pdf, const PdfDetails& details) {
    if (details.attachment_name.empty()) return;
    auto stream = QPDFEFStreamObjectHelper::createEFStream(pdf, details.attachment);
    stream.setSubtype("application/json").setCreationDate(details.date).setModDate(details.date);
    auto file = QPDFFileSpecObjectHelper::createFileSpec(pdf, details.attachment_name, stream);
    file.getObjectHandle().replaceKey("/AFRelationship", QPDFObjectHandle::newName("/Data"));
    QPDFEmbeddedFileDocumentHelper(pdf).replaceEmbeddedFile(details.attachment_name, file);
    pdf.getRoot().replaceKey("/AF", QPDFObjectHandle::newArray({file.getObjectHandle()}));
}

/// Writes the PDF twice, first to number its objects in reading order, then to pack them: the numbers of the engine have no effect.
std::string written(QPDF& pdf) {
    const auto write = [](QPDF& from, qpdf_object_stream_e streams) -> std::string {
        QPDFWriter writer(from);
        writer.setOutputMemory();
        writer.setDeterministicID(true);
        writer.setObjectStreamMode(streams);
        writer.write();
        const auto buffer = writer.getBufferSharedPointer();
        return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
    };
    const std::string numbered = write(pdf, qpdf_o_disable);
    QPDF again;
    open(again, numbered);
    again.getTrailer().removeKey("/ID");
    return write(again, qpdf_o_generate);
}

}   // namespace

PdfContents contents_of_pdf(std::string_view bytes) try {
    QPDF pdf;
    open(pdf, bytes);
    std::map<QPDFObjGen, int> pages;
    PdfContents contents;
    if (QPDFObjectHandle info = pdf.getTrailer().getKey("/Info"); info.isDictionary() && info.getKey("/Title").isString())
        contents.title = info.getKey("/Title").getUTF8Value();
    for (const auto& page : QPDFPageDocumentHelper(pdf).getAllPages()) pages[page.getObjectHandle().getObjGen()] = ++contents.pages;
    for (auto& [item, level] : outline_of(pdf)) {
        const auto page = pages.find(item.getDestPage().getObjGen());
        contents.outline.push_back({item.getTitle(), level, page != pages.end() ? page->second : 0});
    }
    return contents;
} catch (const std::exception& error) {
    throw EngineError("the engine printed no readable PDF: " + printable(error.what()));
}

std::string pdf_date(const std::string& seconds) {
    const auto number = parse_integer(seconds);
    if (!number || *number < 0 || *number > 253402300799) return PdfDetails{}.date;   // up to the year 9999
    const std::time_t time = *number;
    std::tm parts{};
    ::gmtime_r(&time, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof text, "D:%Y%m%d%H%M%SZ", &parts)};
}

std::string finish_pdf(std::string_view bytes, const PdfDetails& details) try {
    QPDF pdf;
    open(pdf, bytes);
    describe(pdf, details);
    rewrite_outline(pdf, details.outline);
    name_elements(pdf);
    attach(pdf, details);
    return written(pdf);
} catch (const Error&) {
    throw;
} catch (const std::exception& error) {
    throw EngineError("the PDF cannot be finished: " + printable(error.what()));
}

}   // namespace meshfolio::report
