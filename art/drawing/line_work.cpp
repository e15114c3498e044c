#include "art/drawing/line_work.h"

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

/// The colours of fields: those of even and of odd classes where neighbours differ in parity, else all.
std::vector<std::size_t> colours_of_class(std::uint32_t number, FieldsBy by, std::size_t count) {
    const bool has_parity = by == FieldsBy::chessboard || by == FieldsBy::kind || by == FieldsBy::symmetry;
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < count; ++i) {
        if (!has_parity || count < 2 || i % 2 == number % 2) fitting.push_back(i);
    }
    return fitting;
}

}  // namespace

bool has_line_work(const Style& style) {
    return style.fields || style.weave || style.parallel.count > 1;
}

LineWork::LineWork(const WordDrawing& drawing, const KolamExamination& examination, const Style& style,
                   const DrawOptions& options)
    : style_(style) {
    const double most = std::min(options.budget / nodes_of_worked_segment, 1e9);
    CurveReader reader([&style](const Pen& pen) { return style.draws(pen); }, static_cast<std::size_t>(most));
    drawing.read({}, {}, reader);
    lines_ = reader.finish(examination);
    if (style.fields || style.weave) {
        meetings_ = find_meetings(lines_, static_cast<std::size_t>(most), options.monitor);
    }
    if (style.fields) {
        fields_ = find_fields(lines_, meetings_, options.monitor);
        classes_ = classify(fields_, *style.fields, examination.symmetry, examination.centre, options.monitor);
    }
    if (style.weave || style.parallel.count > 1) {
        bands_ = std::make_unique<LineBands>(lines_, meetings_, style, options.monitor);
    }
}

void LineWork::add_colours(std::vector<Colour>& palette, std::span<const Colour> others) {
    if (!style_.fields) return;
    const std::vector<Colour> powders = fill_powders(style_, others);
    const int first = static_cast<int>(palette.size());
    palette.insert(palette.end(), powders.begin(), powders.end());
    for (const std::uint32_t number : classes_) {
        const auto fitting = colours_of_class(number, *style_.fields, powders.size());
        const bool has_parity = fitting.size() < powders.size();
        const std::size_t chosen = fitting[(has_parity ? number / 2 : number) % fitting.size()];
        colours_.push_back(powders[chosen].alpha == 0 ? -1 : first + static_cast<int>(chosen));
    }
}

/// The fields that are filled, by colour, as layers and pens are.
std::vector<std::size_t> LineWork::fields_by_colour() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        if (colours_[i] >= 0) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return colours_[a] < colours_[b]; });
    return order;
}

void LineWork::draw_fields(PathSink& sink) const {
    std::vector<glm::dvec2> corners;
    for (const std::size_t i : fields_by_colour()) {
        const Field& field = fields_[i];
        const Pen pen{.colour = colours_[i]};
        if (!field.is_straight) {
            sink.area(field.outline, pen);
            continue;
        }
        corners.clear();
        for (std::size_t k = 0; k + 1 < field.outline.size(); k += 3) corners.push_back(field.outline[k]);
        if (corners.size() > 2) sink.polygon(corners, pen);
    }
}

void LineWork::hatch_fields(const Print& print, const Hatch& hatch, const Monitor& monitor, PathSink& sink) const {
    const double step = print.placement.step;
    const double width = print.style.line_width({}, step) / step;
    const double band = bands_ ? bands_->look(print).band() : width;
    const double spacing = hatch.spacing > 0 ? hatch.spacing / step : width;
    const double inset = band / 2 + std::min(spacing, width) / 2;
    constexpr double tolerance = 0.01;  // millimetres
    std::vector<glm::dvec2> outline;
    for (const std::size_t i : fields_by_colour()) {
        monitor.check();
        const std::vector<glm::dvec2>& curves = fields_[i].outline;
        outline.clear();
        for (std::size_t k = 0; k + 3 < curves.size(); k += 3) {
            outline.push_back(curves[k]);
            flatten(curves[k], curves[k + 1], curves[k + 2], curves[k + 3], tolerance / step,
                    [&](glm::dvec2 at) { outline.push_back(at); });
            outline.pop_back();
        }
        for (const glm::dvec2 along : hatch_directions(hatch, print.placement)) {
            for (const auto& line : hatch_lines(outline, along, spacing, inset, monitor)) {
                sink.begin_stroke(line.front(), Pen{.colour = colours_[i]});
                sink.lines(std::span(line).subspan(1));
                sink.end_stroke(false);
            }
        }
    }
}

double LineWork::parallel_width() const {
    const int between = style_.parallel.count - 1;
    if (between == 0) return 0;
    Print unplaced;
    unplaced.style = style_;
    unplaced.placement.step = 1;
    const BandLook look = bands_->look(unplaced);
    // The width that fits is known only in steps.
    return between * (style_.stroke.in_steps ? look.spacing : look.wanted);
}

void LineWork::draw_lines(const Print& print, std::span<const int> colours, PathSink& sink) const {
    const auto colour = [&](std::size_t line) {
        return colours.empty() ? -1 : colours[lines_.lines[line].orbit % colours.size()];
    };
    bands_->draw(print, colour, sink);
}

}  // namespace sikku
