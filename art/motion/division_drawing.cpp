#include "art/motion/division_drawing.h"

#include "art/style/contrast.h"
#include "engine/geometry/moved_path.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace sikku {
namespace {

Colour faded(Colour colour, double opacity) {
    const Colour clear{colour.red, colour.green, colour.blue, 0};
    return mixed(clear, colour, opacity);
}

/// Draws in other colours and with other widths.
class OtherPens : public PathFilter {
public:
    /// @param line, fill  index of the colour of a pen
    OtherPens(PathSink& sink, double width, std::function<int(const Pen&)> line, std::function<int(const Pen&)> fill)
        : Forwarding(sink), width_(width), line_(std::move(line)), fill_(std::move(fill)) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, other(pen, line_)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(other(pen, line_)); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        sink_.polygon(vertices, other(pen, fill_));
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        sink_.area(outline, other(pen, fill_));
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        sink_.disc(centre, radius, other(pen, fill_));
    }

private:
    Pen other(Pen pen, const std::function<int(const Pen&)>& colour) const {
        const int index = colour(pen);
        pen.colour = index;
        pen.width *= width_;
        return pen;
    }

    double width_;
    std::function<int(const Pen&)> line_, fill_;
};

}  // namespace

DivisionDrawing::DivisionDrawing(std::shared_ptr<const Division> division, const DivisionMoment& moment,
                                 const DrawingOptions& options, const Reading& reading)
    : Drawing(options, reading), division_(std::move(division)), style_(division_->style) {
    const DivisionStage& stage = division_->stages[moment.stage];
    if (moment.fade > 0) {
        // The first stage appears below the last one before that vanishes, so that the ground does not shine through;
        // its lines, which are drawn over all fills, appear all the time.
        const double rest = 1 - moment.fade;
        add_picture(division_->stages.front(), moment.fade, std::min(1.0, 2 * moment.fade), true);
        add_picture(stage, rest, std::min(1.0, 2 * rest), true);
        return;
    }
    if (moment.share >= 1 || moment.stage == 0) {
        add_picture(stage, 1, 1, true);
        return;
    }
    const DivisionStage& before = division_->stages[moment.stage - 1];
    const DivisionTracks& tracks = division_tracks(stage.kind);
    const double rest = value_at(tracks.before, moment.share);
    add_fills(before, rest);
    add_parts(stage, moment.share);
    add_picture(before, rest, rest, false);
    const double arrival = value_at(tracks.arrival, moment.share);
    if (stage.has_more_lines) add_picture(stage, arrival, arrival, false);
}

/// The index of a colour, which is added if it is missing.
int DivisionDrawing::index_of(Colour colour) {
    const auto begin = style_.palette.begin() + static_cast<std::ptrdiff_t>(division_->style.palette.size());
    auto found = std::find(begin, style_.palette.end(), colour);
    if (found == style_.palette.end()) found = style_.palette.insert(found, colour);
    return static_cast<int>(found - style_.palette.begin());
}

void DivisionDrawing::add_picture(const DivisionStage& stage, double lines, double fills, bool has_polygons) {
    if (!(lines > 0) && !(fills > 0)) return;
    const Style& style = division_->style;
    OtherPens pens(
        path_, style.stroke.in_steps ? stage.scale : 1.0,
        [&](const Pen& pen) { return lines < 1 ? index_of(faded(style.line_colour(pen), lines)) : style.index(pen); },
        [&](const Pen& pen) {
            return fills < 1 ? index_of(faded(style.fill_colour(pen), fills)) : style.index(pen);
        });
    MovedPath moved(pens, stage.place);
    WithoutPolygons bare(moved);
    stage.picture.draw(has_polygons ? static_cast<PathSink&>(moved) : bare);
}

/// Adds fills mixed with the ground, so that seams are invisible.
void DivisionDrawing::add_fills(const DivisionStage& stage, double opacity) {
    if (!(opacity > 0)) return;
    Colour ground = style_.ground.value_or(Colour{255, 255, 255, 255});
    ground.alpha = 255;
    MovedPath moved(path_, stage.place);
    for (std::size_t i = 0; i < stage.tiles.size(); ++i) {
        const Colour colour = stage.colours[i];
        if (colour.alpha == 0) continue;
        moved.polygon(stage.tiles.polygon(i), Pen{.colour = index_of(mixed(ground, colour, opacity))});
    }
}

void DivisionDrawing::add_parts(const DivisionStage& stage, double share) {
    const DivisionTracks& tracks = division_tracks(stage.kind);
    const double size = value_at(tracks.size, share), way = value_at(tracks.way, share),
                 colour = value_at(tracks.colour, share), opacity = value_at(tracks.opacity, share);
    std::optional<Pen> outline = stage.outline;
    if (outline) {
        outline->width *= value_at(tracks.outline, share) * (style_.stroke.in_steps ? stage.scale : 1.0);
        if (!(outline->width > 0)) outline.reset();
        if (outline && opacity < 1) outline->colour = index_of(faded(style_.line_colour(*outline), opacity));
    }
    MovedPath moved(path_, stage.place);
    std::vector<glm::dvec2> corners;
    for (std::size_t i = 0; i < stage.tiles.size(); ++i) {
        const DivisionStage::Part& part = stage.parts[i];
        const glm::dvec2 shift = way * part.way;
        corners.clear();
        for (const glm::dvec2 corner : stage.tiles.polygon(i)) {
            corners.push_back(part.middle + size * (corner - part.middle) + shift);
        }
        const Colour fill = faded(mixed(part.from, stage.colours[i], colour), opacity);
        if (fill.alpha > 0) moved.polygon(corners, Pen{.colour = index_of(fill)});
        if (!outline) continue;
        moved.begin_stroke(corners.front(), *outline);
        moved.lines(std::span(corners).subspan(1));
        moved.lines(std::span(corners).first(1));
        moved.end_stroke(true);
    }
}

void DivisionDrawing::read(const Print&, const Window&, PathSink& sink) const {
    path_.draw(sink);
}

}  // namespace sikku
