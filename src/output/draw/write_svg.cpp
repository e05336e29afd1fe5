#include <algorithm>
#include <map>

#include "base/base64.h"
#include "base/number_text.h"
#include "base/sha256.h"
#include "embedded_page_fonts.h"
#include "output/draw/write_drawing.h"
#include "png/png.h"
#include "report/escape.h"

namespace meshfolio::output {

namespace {

using render::Drawing;
using render::Rgba;

/// Returns an attribute: ` x="1.5"`.
std::string attribute(const std::string& name, const std::string& value) { return " " + name + "=\"" + value + "\""; }
std::string attribute(const std::string& name, double value) { return attribute(name, plain_text(value, 7)); }

std::string box(double left, double top, double width, double height) {
    return attribute("x", left) + attribute("y", top) + attribute("width", width) + attribute("height", height);
}

std::string rgb(Rgba c) { return "rgb(" + std::to_string(c.r) + "," + std::to_string(c.g) + "," + std::to_string(c.b) + ")"; }

/// Returns the attributes that fill a shape, or with `property` "stroke" draw its outline.
std::string painted_in(Rgba color, const std::string& property = "fill") {
    return attribute(property, rgb(color)) + (color.a < 255 ? attribute(property + "-opacity", color.a / 255.0) : "");
}

std::string outlined(double width, Rgba color) { return " fill=\"none\"" + attribute("stroke-width", width) + painted_in(color, "stroke"); }

/// Returns numbers in pairs: "0,1 2,3".
std::string point_list(const std::vector<glm::dvec2>& points) {
    std::string text;
    for (const glm::dvec2& p : points) text += (text.empty() ? "" : " ") + plain_text(p.x, 7) + "," + plain_text(p.y, 7);
    return text;
}

std::string font_face(bool is_bold) {
    const auto fonts = meshfolio_embedded::embedded_page_fonts();
    const auto font = std::ranges::find(fonts, is_bold ? "sans-bold.woff2" : "sans-regular.woff2", &meshfolio_embedded::File::name);
    return std::string("@font-face { font-family: 'Report Sans'; font-weight: ") + (is_bold ? "700" : "400") +
           "; src: url(data:font/woff2;base64," + base64(font->bytes) + ") }\n";
}

/// The elements of a drawing, to which each call adds one.
struct SvgElements {
    std::string body;
    std::map<std::string, std::string> gradients;   // by their stops
    std::map<bool, std::string> fonts;              // by whether they are bold

    void operator()(const Drawing::Picture& picture) {
        body += "<image" + box(picture.left, picture.top, picture.image->width, picture.image->height) +
                " xlink:href=\"data:image/png;base64," + base64(render::encode_png(*picture.image)) + "\"/>\n";
    }
    void operator()(const Drawing::Text& text) {
        const render::TextLine line = render::text_line(text.text, text.style);
        if (line.glyphs.empty()) return;
        const bool is_bold = text.style.weight == render::Weight::bold;
        if (!fonts.contains(is_bold)) fonts[is_bold] = font_face(is_bold);
        body += "<text" + attribute("x", text.at.x + line.left) + attribute("y", text.at.y) + attribute("font-size", line.em) +
                attribute("textLength", line.width) + (is_bold ? " font-weight=\"700\"" : "") + painted_in(text.style.color) + ">";
        for (const render::PlacedGlyph& glyph : line.glyphs) body += report::xml_escape(std::string(glyph.text));
        body += "</text>\n";
    }
    void operator()(const Drawing::Path& path) {
        body += "<polyline" + attribute("points", point_list(path.points)) + outlined(path.width, path.color) + "/>\n";
    }
    void operator()(const Drawing::Ring& ring) {
        body += "<circle" + attribute("cx", ring.centre.x) + attribute("cy", ring.centre.y) + attribute("r", ring.radius) +
                outlined(ring.width, ring.color) + "/>\n";
    }
    void operator()(const Drawing::Area& area) {
        body += "<polygon" + attribute("points", point_list(area.corners)) + painted_in(area.color) + "/>\n";
    }
    void operator()(const Drawing::Ramp& ramp) {
        std::string stops;
        const auto& colors = ramp.colormap->stops;
        for (std::size_t i = 0; i < colors.size(); ++i)
            stops += "<stop" + attribute("offset", double(i) / double(std::max<std::size_t>(1, colors.size() - 1))) +
                     attribute("stop-color", rgb(colors[i])) + "/>";
        const std::string id = gradients[stops] = "ramp-" + sha256(stops).substr(0, 8);   // unlike those of other files in one page
        body += "<rect" + box(ramp.left, ramp.top, ramp.right - ramp.left, ramp.bottom - ramp.top) + attribute("fill", "url(#" + id + ")") +
                "/>\n";
    }
};

}   // namespace

std::string write_svg(const Drawing& drawing, double resolution, const std::string& title) {
    SvgElements elements;
    if (drawing.background.a > 0)
        elements.body += "<rect" + box(0, 0, drawing.width, drawing.height) + painted_in(drawing.background) + "/>\n";
    for (const Drawing::Item& item : drawing.items) std::visit(elements, item);
    const auto millimetres = [&](int pixels) { return plain_text(25.4 * pixels / resolution, 9) + "mm"; };
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" xml:space=\"preserve\"" +
                      attribute("width", millimetres(drawing.width)) + attribute("height", millimetres(drawing.height)) +
                      attribute("viewBox", "0 0 " + std::to_string(drawing.width) + " " + std::to_string(drawing.height)) +
                      " font-family=\"'Report Sans', Inter, Helvetica, Arial, sans-serif\" text-rendering=\"geometricPrecision\"" +
                      " stroke-linecap=\"round\" stroke-linejoin=\"round\" fill-rule=\"evenodd\">\n";
    if (!title.empty()) svg += "<title>" + report::xml_escape(report::safe_text(title)) + "</title>\n";
    svg += "<style>text { white-space: pre }\n";
    for (const auto& [weight, face] : elements.fonts) svg += face;
    svg += "</style>\n<defs>\n";
    for (const auto& [stops, id] : elements.gradients) svg += "<linearGradient" + attribute("id", id) + ">" + stops + "</linearGradient>\n";
    return svg + "</defs>\n" + elements.body + "</svg>\n";
}

std::string with_fonts(std::string svg) {
    svg.insert(svg.find('>', svg.find("<svg ")) + 1, "\n<style>" + font_face(false) + font_face(true) + "</style>");
    return svg;
}

}   // namespace meshfolio::output
