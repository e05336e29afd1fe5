#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/number_text.h"
#include "base/utf8.h"
#include "output/draw/write_drawing.h"
#include "png/png.h"
#include "report/escape.h"
#include "report/pdf/pdf_finish.h"

namespace meshfolio::output {

namespace {

using render::Drawing;
using render::Image;
using render::Rgba;

/// Returns numbers with up to four decimals, without powers of ten, each with a space behind it.
template <class... Numbers> std::string operands(Numbers... numbers) {
    return ((plain_text(std::round(1e4 * double(numbers)) / 1e4, 12) + " ") + ...);
}

/// Returns four hexadecimal digits.
std::string hex16(unsigned value) {
    std::string digits;
    for (const unsigned shift : {12U, 8U, 4U, 0U}) digits += "0123456789ABCDEF"[value >> shift & 15];
    return digits;
}

/// Returns UTF-16 in hexadecimal of a character in UTF-8.
std::string hex_utf16(std::string_view character) {
    const char32_t c = code_point_at(character, 0).value;
    return c < 0x10000 ? hex16(c) : hex16(0xD7C0 + (c >> 10)) + hex16(0xDC00 + (c & 1023));
}

/// Returns the operators of straight lines from point to point.
std::string lines_through(const std::vector<glm::dvec2>& points) {
    std::string lines;
    for (const glm::dvec2& p : points) lines += operands(p.x, p.y) + (lines.empty() ? "m " : "l ");
    return lines;
}

/// A PDF without compression: its objects, numbered from 1 on, and their table.
class PdfObjects {
public:
    /// Adds an object and returns a reference to it.
    std::string add(const std::string& object) {
        places_.push_back(bytes_.size());
        bytes_ += std::to_string(places_.size()) + " 0 obj\n" + object + "\nendobj\n";
        return std::to_string(places_.size()) + " 0 R";
    }
    std::string add_stream(const std::string& entries, std::string_view data) {
        return add("<< " + entries + " /Length " + std::to_string(data.size()) + " >>\nstream\n" + std::string(data) + "\nendstream");
    }
    /// Returns the file of one page. @param page  its entries, without the parent
    std::string with_page(const std::string& page) {
        const std::string pages = std::to_string(places_.size() + 2) + " 0 R";
        const std::string kid = add("<< /Type /Page /Parent " + pages + " " + page + " >>");
        add("<< /Type /Pages /Count 1 /Kids [" + kid + "] >>");
        const std::string root = add("<< /Type /Catalog /Pages " + pages + " >>"), count = std::to_string(places_.size() + 1);
        const std::string begin = std::to_string(bytes_.size());
        bytes_ += "xref\n0 " + count + "\n0000000000 65535 f \n";
        for (const std::size_t place : places_) bytes_ += std::to_string(10'000'000'000 + place).substr(1) + " 00000 n \n";
        return bytes_ + "trailer << /Size " + count + " /Root " + root + " >>\nstartxref\n" + begin + "\n%%EOF\n";
    }

private:
    std::string bytes_ = "%PDF-1.4\n";
    std::vector<std::size_t> places_;
};

std::string font_name(render::Weight weight) { return weight == render::Weight::bold ? "/ReportSans-Bold" : "/ReportSans-Regular"; }

/// The characters that a drawing uses of a font. Each gets a code from 1 on, because several may have one glyph.
struct UsedFont {
    struct Code {
        unsigned code;
        double width;   // [em/1000]
    };
    std::map<std::string, Code, std::less<>> codes = {};
    std::string widths = {}, glyphs = std::string(2, '\0'), unicode = {};   // in the order of the codes

    Code code_of(const render::PlacedGlyph& glyph, double em) {
        if (const auto known = codes.find(glyph.text); known != codes.end()) return known->second;
        const Code code{static_cast<unsigned>(codes.size() + 1), 1000 * glyph.advance / em};
        widths += operands(code.width);
        glyphs += {static_cast<char>(glyph.index >> 8), static_cast<char>(glyph.index)};
        unicode += "1 beginbfchar <" + hex16(code.code) + "> <" + hex_utf16(glyph.text) + "> endbfchar\n";
        return codes.emplace(glyph.text, code).first->second;
    }

    std::string added_to(PdfObjects& objects, const std::string& name, const render::FontFile& font) const {
        const std::string file = objects.add_stream("/Length1 " + std::to_string(font.bytes.size()), font.bytes);
        const std::string descriptor =
            objects.add("<< /Type /FontDescriptor /FontName " + name + " /Flags 4 /ItalicAngle 0 /StemV 80 /FontFile2 " + file +
                        " /FontBBox [" + operands(font.left, font.low, font.right, font.high) + "] /Ascent " + operands(font.ascent) +
                        "/Descent " + operands(font.descent) + "/CapHeight " + operands(font.capital) + ">>");
        const std::string descendant = "<< /Type /Font /Subtype /CIDFontType2 /BaseFont " + name +
                                       " /CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) /Supplement 0 >> /FontDescriptor " +
                                       descriptor + " /W [1 [" + widths + "]] /CIDToGIDMap " + objects.add_stream("", glyphs) + " >>";
        const std::string map =
            "/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n/CMapName /Adobe-Identity-UCS def\n"
            "/CMapType 2 def\n1 begincodespacerange <0000> <FFFF> endcodespacerange\n" +
            unicode + "endcmap CMapName currentdict /CMap defineresource pop end end\n";
        return objects.add("<< /Type /Font /Subtype /Type0 /BaseFont " + name + " /Encoding /Identity-H /DescendantFonts [" + descendant +
                           "] /ToUnicode " + objects.add_stream("", map) + " >>");
    }
};

/// The content of a page and what it needs; each call adds an item of a drawing.
struct PdfContent {
    PdfObjects objects = {};
    std::string operators = {};
    std::map<std::string, std::map<std::string, std::string>> resources = {};   // kind, name, object
    std::map<render::Weight, UsedFont> fonts = {};
    /// Returns the operators that set a colour. @param set  "rg" for areas, "RG" for lines
    std::string painting(Rgba color, const char* set) {
        const std::string opacity = "/a" + std::to_string(color.a), share = operands(color.a / 255.0);
        if (color.a < 255) resources["/ExtGState"][opacity] = "<< /CA " + share + "/ca " + share + ">>";
        return (color.a < 255 ? opacity + " gs " : "") + operands(color.r / 255.0, color.g / 255.0, color.b / 255.0) + set + " ";
    }
    std::string stroking(double width, Rgba color) { return painting(color, "RG") + "1 J 1 j " + operands(width) + "w "; }
    /// Adds operators that do not change the state for later ones.
    void add(const std::string& text) { operators += "q " + text + "Q\n"; }
    /// Adds something that fills the unit square, in a box. Poppler would round exact edges up to the next pixel.
    void place(double left, double top, double width, double height, const std::string& unit) {
        constexpr double inwards = 0.002;
        add(operands(width - 2 * inwards, 0, 0, 2 * inwards - height, left + inwards, top + height - inwards) + "cm " + unit);
    }
    /// Adds the pixels of our PNG, which PDF compresses alike, and the alpha apart.
    void operator()(const Drawing::Picture& picture) {
        Image opaque = *picture.image;
        std::string alpha;
        for (Rgba& pixel : opaque.pixels) alpha += static_cast<char>(std::exchange(pixel.a, std::uint8_t{255}));
        const std::string png = render::encode_png(opaque), width = std::to_string(opaque.width);
        const std::size_t begin = png.find("IDAT") + 4, behind = 4 + 12;   // one chunk, behind it its checksum and an empty chunk
        std::string entries =
            "/Type /XObject /Subtype /Image /BitsPerComponent 8 /Width " + width + " /Height " + std::to_string(opaque.height);
        if (alpha.find_first_not_of('\xFF') != alpha.npos)
            entries += " /SMask " + objects.add_stream(entries + " /ColorSpace /DeviceGray", alpha);
        entries += " /ColorSpace /DeviceRGB /Filter /FlateDecode /DecodeParms << /Predictor 15 /Colors 3 /Columns " + width + " >>";
        const std::string name = "/p" + std::to_string(resources["/XObject"].size());
        resources["/XObject"][name] = objects.add_stream(entries, std::string_view(png).substr(begin, png.size() - begin - behind));
        place(picture.left, picture.top, opaque.width, opaque.height, name + " Do ");
    }
    void operator()(const Drawing::Text& text) {
        const render::TextLine line = render::text_line(text.text, text.style);
        if (line.glyphs.empty()) return;
        UsedFont& font = fonts[text.style.weight];
        std::string shown;
        double at = 0, rise = 0;   // [pixels]
        for (const render::PlacedGlyph& glyph : line.glyphs) {
            const auto [code, width] = font.code_of(glyph, line.em);
            if (glyph.rise != rise) shown += "] TJ " + operands(rise = glyph.rise) + "Ts [";
            if (const double back = 1000 * (at - glyph.place) / line.em; std::abs(back) > 0.01) shown += operands(back), at = glyph.place;
            shown += "<" + hex16(code) + ">";
            at += width * line.em / 1000;
        }
        add("BT " + painting(text.style.color, "rg") + font_name(text.style.weight) + " " + operands(line.em) + "Tf " +
            operands(1, 0, 0, -1, text.at.x + line.left, text.at.y) + "Tm [" + shown + "] TJ ET ");
    }
    void operator()(const Drawing::Path& path) { add(stroking(path.width, path.color) + lines_through(path.points) + "S "); }
    void operator()(const Drawing::Ring& ring) {
        const double x = ring.centre.x, y = ring.centre.y, r = ring.radius,
                     k = 4 * (std::sqrt(2) - 1) / 3 * r;   // of the nearest cubic curves
        add(stroking(ring.width, ring.color) + operands(x + r, y) + "m " + operands(x + r, y + k, x + k, y + r, x, y + r) + "c " +
            operands(x - k, y + r, x - r, y + k, x - r, y) + "c " + operands(x - r, y - k, x - k, y - r, x, y - r) + "c " +
            operands(x + k, y - r, x + r, y - k, x + r, y) + "c s ");
    }
    void operator()(const Drawing::Area& area) { add(painting(area.color, "rg") + lines_through(area.corners) + "f* "); }
    /// A shading along the unit of x with the colours of the map.
    void operator()(const Drawing::Ramp& ramp) {
        std::string colors;
        const std::size_t last = std::max<std::size_t>(1, ramp.colormap->stops.size() - 1);
        for (std::size_t i = 0; i <= last; ++i) {
            const Rgba color = render::color_at(*ramp.colormap, double(i) / double(last));
            colors += {static_cast<char>(color.r), static_cast<char>(color.g), static_cast<char>(color.b)};
        }
        const std::string name = "/s" + std::to_string(resources["/Shading"].size());
        const std::string function = objects.add_stream(
            "/FunctionType 0 /Domain [0 1] /Range [0 1 0 1 0 1] /BitsPerSample 8 /Size [" + std::to_string(last + 1) + "]", colors);
        resources["/Shading"][name] =
            "<< /ShadingType 2 /ColorSpace /DeviceRGB /Coords [0 0 1 0] /Extend [true true] /Function " + function + " >>";
        place(ramp.left, ramp.top, ramp.right - ramp.left, ramp.bottom - ramp.top, "0 0 1 1 re W n " + name + " sh ");
    }
};

}   // namespace

std::string write_pdf(const Drawing& drawing, double resolution, const std::string& title) {
    PdfContent content;
    const double w = drawing.width, h = drawing.height, scale = 72 / resolution;
    const auto points = [&](double pixels) { return operands(std::floor(1e4 * scale * pixels) / 1e4); };   // no part of a further pixel
    content.operators = plain_text(scale, 12) + " 0 0 " + plain_text(-scale, 12) + " 0 " + points(h) + "cm\n";
    if (drawing.background.a > 0) content(Drawing::Area{{{0, 0}, {w, 0}, {w, h}, {0, h}}, drawing.background});
    for (const Drawing::Item& item : drawing.items) std::visit(content, item);
    for (const auto& [weight, font] : content.fonts)
        content.resources["/Font"][font_name(weight)] = font.added_to(content.objects, font_name(weight), render::font_file(weight));
    std::string resources;
    for (const auto& [kind, objects] : content.resources) {
        resources += kind + " << ";
        for (const auto& [name, object] : objects) resources += name + " " + object + " ";
        resources += ">> ";
    }
    const std::string pdf =
        content.objects.with_page("/MediaBox [0 0 " + points(w) + points(h) + "] /Contents " +
                                  content.objects.add_stream("", content.operators) + " /Resources << " + resources + ">>");
    report::PdfDetails details;
    details.title = report::safe_text(title);
    details.creator = "meshfolio";
    return report::finish_pdf(pdf, details);
}

}   // namespace meshfolio::output
