#include "report/pdf/pdf_packing.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/number_text.h"
#include "report/page/page_design.h"

namespace meshfolio::report {

namespace {

constexpr std::size_t in_a_stream = 100, bytes_of_a_place = 4;

/// Where an object is: its byte in the file, or its index in the object stream of that number.
struct Place {
    std::size_t stream = 0, at = 0;
};

std::string_view between(std::string_view text, std::string_view before, std::string_view after, std::size_t from) {
    const std::size_t at = text.find(before, from), begin = at + before.size();
    const std::size_t end = at == std::string_view::npos ? at : text.find(after, begin);
    if (end == std::string_view::npos) throw EngineError("the PDF cannot be packed: it has no " + std::string(before));
    return text.substr(begin, end - begin);
}

std::size_t number_in(std::string_view text) { return static_cast<std::size_t>(parse_integer(std::string(text)).value_or(0)); }

/// Big-endian.
std::string bytes_of(std::size_t number, std::size_t count) {
    std::string bytes;
    for (std::size_t i = count; i-- > 0;) bytes += static_cast<char>(number >> (8 * i) & 255);
    return bytes;
}

/// A PDF that grows by one object after the other.
struct Packing {
    std::string pdf;
    std::vector<Place> places;   // by number

    void add(std::size_t number, std::string_view object) {
        places[number] = {0, pdf.size()};
        pdf += std::to_string(number) + " 0 obj\n";
        pdf += object;
        pdf += "\nendobj\n";
    }
    void add_stream(const std::string& entries, const std::string& bytes) {
        const std::string zlib = zlib_of(bytes);
        places.emplace_back();
        add(places.size() - 1,
            "<< " + entries + " /Filter /FlateDecode /Length " + std::to_string(zlib.size()) + " >>\nstream\n" + zlib + "\nendstream");
    }
    void add_together(const std::vector<std::pair<std::size_t, std::string_view>>& objects) {
        std::string index, text;
        for (std::size_t i = 0; i < objects.size(); ++i) {
            places[objects[i].first] = {places.size(), i};
            index += std::to_string(objects[i].first) + " " + std::to_string(text.size()) + " ";
            text += objects[i].second;
            text += "\n";
        }
        add_stream("/Type /ObjStm /N " + std::to_string(objects.size()) + " /First " + std::to_string(index.size()), index + text);
    }
    void end(std::string_view trailer) {
        const std::size_t begin = pdf.size(), size = places.size() + 1;
        places.push_back({0, begin});
        std::string table = bytes_of(0, 1 + bytes_of_a_place) + bytes_of(65535, 2);
        for (std::size_t number = 1; number < size; ++number) {
            const auto& [stream, at] = places[number];
            table += stream == 0 ? bytes_of(1, 1) + bytes_of(at, bytes_of_a_place) + bytes_of(0, 2)
                                 : bytes_of(2, 1) + bytes_of(stream, bytes_of_a_place) + bytes_of(at, 2);
        }
        places.pop_back();
        add_stream("/Type /XRef /W [1 4 2] /Size " + std::to_string(size) + " " + std::string(trailer), table);
        pdf += "startxref\n" + std::to_string(begin) + "\n%%EOF\n";
    }
};

}   // namespace

std::string packed_pdf(std::string_view pdf) {
    const std::size_t table = number_in(between(pdf, "startxref\n", "\n", pdf.rfind("startxref\n")));
    const std::size_t count = number_in(between(pdf, "xref\n0 ", "\n", table));
    const std::size_t first = pdf.find('\n', table + 5) + 1, line = 20;
    const auto begin_of = [&](std::size_t number) { return number == count ? table : number_in(pdf.substr(first + number * line, 10)); };
    Packing packing{std::string(pdf.substr(0, begin_of(1))), std::vector<Place>(count)};
    std::vector<std::pair<std::size_t, std::string_view>> together;
    for (std::size_t number = 1; number < count; ++number) {
        const std::string_view whole = pdf.substr(begin_of(number), begin_of(number + 1) - begin_of(number));
        const std::size_t begin = whole.find(" obj\n") + 5, end = whole.rfind("\nendobj");
        const std::string_view object = whole.substr(begin, end - begin);
        if (object.ends_with("endstream")) {
            packing.add(number, object);
        } else {
            together.emplace_back(number, object);
        }
        if (together.size() == in_a_stream || (number + 1 == count && !together.empty())) {
            packing.add_together(together);
            together.clear();
        }
    }
    std::string trailer(between(pdf, "trailer << ", ">>\nstartxref", table));
    const std::string size = "/Size " + std::to_string(count) + " ";   // it grows
    trailer.erase(std::min(trailer.find(size), trailer.size()), size.size());
    packing.end(trailer);
    return std::move(packing.pdf);
}

}   // namespace meshfolio::report
