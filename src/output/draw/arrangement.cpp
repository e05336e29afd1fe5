#include "output/draw/arrangement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "output/draw/framing.h"
#include "output/draw/surface_of.h"
#include "report/drawn_figure.h"
#include "sheet/view_label.h"

namespace meshfolio::output {

namespace {

constexpr std::size_t most_large = 12, in_a_line = 4, in_a_gallery_line = 6;
constexpr int flat_in_a_line = 3;

/// True if labels are names of views, with their tripods.
bool names_views(const FigureRequest& request) {
    const auto is_view = [](const Panel& panel) { return !panel.view.empty() && panel.label == panel.view; };
    return request.layout == Layout::six_views || std::ranges::any_of(request.panels, is_view);
}

/// Returns the height of a line of words.
int line_of(const FigureRequest& request, double em) {
    return static_cast<int>(std::lround(names_views(request) ? render::view_label_height(0.95 * em) : 1.7 * em));
}

/// Fills a sheet. Lengths are in pixels.
class Arranger {
public:
    Arranger(const FigureRequest& request, const std::vector<PanelPictures>& panels, double em, int cell)
        : request_(request), panels_(panels), cell_(cell), line_(line_of(request, em)), gap_(gap_of(request, em)) {
        sheet_.em = em;
        sheet_.least_width = static_cast<int>(std::lround(16 * em));   // for the numbers of a colour bar
        if (request_.layout == Layout::six_views) place_blocks();
        else place_grid();
    }

    render::FigureSheet sheet() { return std::move(sheet_); }

private:
    const FigureRequest& request_;
    const std::vector<PanelPictures>& panels_;
    const int cell_, line_, gap_;
    render::FigureSheet sheet_;

    void place(const std::shared_ptr<const render::Image>& picture, int left, int top) { sheet_.pictures.push_back({picture, left, top}); }
    void place_words(std::string words, int left, int top, int width, bool is_centred = true) {
        if (!words.empty()) sheet_.words.push_back({std::move(words), left, top, width, line_, is_centred});
    }
    /// Places the label of panel p, with its small bar in the same line or in the next.
    void place_label(std::size_t p, int left, int top, int width, bool in_one_line = true) {
        const Panel& panel = request_.panels[p];
        if (!in_one_line || !panel.range) place_words(panel.label, left, top, width);
        if (panel.range)
            sheet_.words.push_back(
                {in_one_line ? panel.label : "", left, in_one_line ? top : top + line_, width, line_, true, small_bar_of(*panel.range)});
    }

    /// Places the pictures from three quarters with their labels below, or between the heads of a matrix.
    void place_grid() {
        const bool matrix = !request_.columns.empty() || !request_.rows.empty();
        const auto columns = static_cast<std::size_t>(panels_in_a_line(request_));
        const bool bars = std::ranges::any_of(request_.panels, [](const Panel& panel) { return panel.range.has_value(); });
        int width = (bars ? 16 : 6) * line_, height = 0;
        for (const PanelPictures& panel : panels_) {
            if (panel.empty()) continue;
            width = std::max(width, panel[0]->width);
            height = std::max(height, panel[0]->height);
        }
        if (cell_ > 0) width = cell_;
        const int left = request_.rows.empty() ? 0 : 6 * line_, top = request_.columns.empty() ? 0 : line_;
        const bool named = (panels_.size() > 1 && !matrix) || (request_.new_line_after > 0 && !request_.panels[0].label.empty());
        const std::size_t block = request_.new_line_after > 0 ? static_cast<std::size_t>(request_.new_line_after) : columns;
        const std::size_t lines = (block + columns - 1) / columns;   // of a block
        const int across = width + gap_, down = height + gap_ + (named ? line_ : 0) + (bars ? line_ : 0);
        for (std::size_t p = 0; p < panels_.size(); ++p) {
            const int x = left + static_cast<int>(p % block % columns) * across;
            const int y = top + static_cast<int>(p / block * lines + p % block / columns) * down;
            if (!panels_[p].empty()) place(panels_[p][0], x + (width - panels_[p][0]->width) / 2, y);
            if (named || bars) place_label(p, x, y + height, width, false);
            if (panels_[p].empty()) place_words(request_.panels[p].label, x, y + height / 2 - line_ / 2, width);
        }
        for (std::size_t c = 0; c < request_.columns.size(); ++c)
            place_words(request_.columns[c], left + static_cast<int>(c) * across, 0, width);
        for (std::size_t r = 0; r < request_.rows.size(); ++r)
            place_words(request_.rows[r], 0, top + static_cast<int>(r) * down + height / 2 - line_ / 2, left - gap_, false);
    }

    /// Places each panel's picture from three quarters with its six views beside it: two lines of views for a single panel, one line for
    /// each of several. Flat panels share lines.
    void place_blocks() {
        int width = 0, height = lines_of_views() * views_height();
        for (const PanelPictures& panel : panels_) {
            width = std::max(width, panel[0]->width + (is_flat(panel) ? 0 : 2 * gap_ + views_width(panel)));
            height = std::max(height, panel[0]->height);
        }
        const bool named = panels_.size() > 1, any_flat = std::ranges::any_of(panels_, is_flat);
        const int least = 13 * line_;   // for the words of a flat panel
        if (any_flat) width = std::max(width, least);
        const int down = height + gap_ + (named ? line_ : 0) + (any_flat ? line_ : 0);
        int x = 0, y = -down;
        for (std::size_t p = 0; p < panels_.size(); ++p) {
            const int large = panels_[p][0]->width, above = (height - panels_[p][0]->height) / 2;
            const bool flat = is_flat(panels_[p]);
            const int cell = flat && named ? std::max(least, width / flat_in_a_line) : width;
            const bool in_group = p % static_cast<std::size_t>(request_.states) != 0;
            if (p == 0 || !flat || x + cell > width || !is_flat(panels_[p - 1])) x = 0, y += down + (p == 0 || in_group ? 0 : gap_);
            place(panels_[p][0], flat ? x + (cell - large) / 2 : x, y + above);
            if (!flat) place_views(panels_[p], x + large + 2 * gap_, y + (height - lines_of_views() * views_height()) / 2);
            int below = y + height;
            if (named) place_label(p, x, std::exchange(below, below + line_), cell);
            if (flat) place_words(flat_panel_note(*view_of_flat(*request_.panels[p].mesh, request_.sight)), x, below, cell);
            x += cell;
        }
    }

    static bool is_flat(const PanelPictures& panel) { return panel.size() == 1; }
    int lines_of_views() const { return panels_.size() == 1 ? 2 : 1; }
    std::size_t views_in_a_line() const { return panels_.size() == 1 ? 3 : 6; }

    int views_height() const {
        int height = 0;
        for (const PanelPictures& panel : panels_)
            for (std::size_t i = 1; i < panel.size(); ++i) height = std::max(height, panel[i]->height);
        return height == 0 ? 0 : height + line_ + gap_;
    }
    int view_width(const render::Image& view) const { return std::max(view.width, 3 * line_); }
    int views_width(const PanelPictures& panel) const {
        int width = 0;
        for (std::size_t i = 1; i < panel.size() && i <= views_in_a_line(); ++i) width += view_width(*panel[i]) + gap_;
        return width;
    }

    /// Places the six views of a panel, each with its name below.
    void place_views(const PanelPictures& panel, int left, int top) {
        const std::vector<render::View> directions = views_in_reading_order(request_.sight);
        const int height = views_height() - line_ - gap_;
        int x = left;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            if (i % views_in_a_line() == 0) x = left;
            const render::Image& image = *panel[1 + i];
            const int y = top + static_cast<int>(i / views_in_a_line()) * views_height(), width = view_width(image);
            place(panel[1 + i], x + (width - image.width) / 2, y + (height - image.height) / 2);
            place_words(std::string(directions[i].name), x, y + height, width);
            x += width + gap_;
        }
    }
};

}   // namespace

std::vector<render::View> views_in_reading_order(const render::Sight& sight) {
    std::vector<render::View> views;
    for (const char* name : {"+x", "+y", "+z", "-x", "-y", "-z"})
        views.push_back(render::view_named(name, sight.up.value_or(render::Up::y)));
    return views;
}

std::string flat_panel_note(const render::View& view) {
    return "seen from " + report::DrawnPicture{std::string(view.name)}.direction() + "; its other views are edge-on";
}

int gap_of(const FigureRequest& request, double em) { return line_of(request, em) / 3; }

bool is_gallery(const FigureRequest& request) {
    return request.layout != Layout::six_views && request.panels.size() > most_large && request.columns.empty() && request.rows.empty();
}

int panels_in_a_line(const FigureRequest& request) {
    const std::size_t panels = request.panels.size();
    if (!request.columns.empty()) return static_cast<int>(request.columns.size());
    if (!request.rows.empty()) return static_cast<int>(panels / request.rows.size());
    if (request.layout == Layout::six_views) return 1;
    if (request.in_a_line > 0) return request.in_a_line;
    const std::size_t most = is_gallery(request) ? in_a_gallery_line : in_a_line, lines = (panels + most - 1) / most;
    return static_cast<int>((panels + lines - 1) / lines);   // fills the lines about equally
}

render::FigureSheet sheet_of(const FigureRequest& request, const std::vector<PanelPictures>& panels, double em, int cell) {
    render::FigureSheet sheet = Arranger(request, panels, em, cell).sheet();
    sheet.title = request.title;
    sheet.subtitle = request.subtitle;
    sheet.up = request.sight.up.value_or(render::Up::y);
    if (!request.range) return sheet;
    render::DrawOptions options;
    options.isoline_spacing = request.isoline_spacing;
    const auto has_undefined = [](const Panel& panel) { return panel.values.array().isNaN().any(); };
    sheet.color_bar = color_bar_of(*request.range, std::ranges::any_of(request.panels, has_undefined), options);
    // Several figures may share a range: the histogram shows the values of this one.
    sheet.color_bar->histogram = histogram_of(finite_values(request.panels), sheet.color_bar->range);
    return sheet;
}

}   // namespace meshfolio::output
