#include "art/motion/division_style.h"

#include "art/print/micrometres.h"

#include <fmt/format.h>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace sikku {
namespace {

/// Key frames of one animation, by ten thousandths of a percent of the time.
class CssFrames {
public:
    explicit CssFrames(double total) : total_(total) {}

    void add(double time, const std::string& values) { frames_[std::llround(time / total_ * parts)] += values + ";"; }
    /// Adds an immediate change.
    void change(double time, const std::string& before, const std::string& after) {
        const std::int64_t at = std::llround(time / total_ * parts);
        if (at > 0) frames_[at - 1] += before + ";";
        frames_[at] += after + ";";
    }
    std::string text(const std::string& name) const {
        std::string text = "@keyframes " + name + " {";
        for (const auto& [at, values] : frames_) {
            text += fmt::format(" {}%{{{}}}", decimal(static_cast<double>(at) / (parts / 100), 4),
                                values.substr(0, values.size() - 1));
        }
        return text + " }\n";
    }

private:
    static constexpr double parts = 1e6;
    double total_;
    std::map<std::int64_t, std::string> frames_;
};

std::string css(Colour colour) {
    return colour.alpha == 255 ? hex(colour) : hex(colour) + fmt::format("{:02x}", colour.alpha);
}

std::string number(double value) {
    return decimal(value, 4);
}

/// Width of the outlines of tiles in micrometres.
double outline_width(const Division& division, const DivisionStage& stage, const Placement& placement) {
    return division.style.line_width(*stage.outline, placement.step * stage.scale) * 1000;
}

/// Key frames that show a stage from the appearance of its tiles until they have divided.
std::string stage_frames(const Division& division, std::size_t i, const DivisionClock& clock) {
    const auto number_of_stage = static_cast<int>(i);
    const bool is_first = i == 0, is_last = i + 1 == division.stages.size();
    CssFrames frames(clock.total());
    const std::string hidden = "visibility:hidden", visible = "visibility:visible";
    if (!is_first) {
        frames.add(0, hidden);
        frames.change(clock.begin(number_of_stage), hidden, visible);
    } else {
        frames.add(0, visible);
    }
    if (is_last) {
        frames.add(clock.fade(), "opacity:1");
        frames.add(clock.total(), visible + ";opacity:0");
        return frames.text(fmt::format("g{}", i));
    }
    const DivisionStage& next = division.stages[i + 1];
    double end = 0;
    for (const Keyframe& key : division_tracks(next.kind).before) {
        const double time = clock.begin(number_of_stage + 1) + key.at * clock.times().division;
        end = time;
        frames.add(time, "opacity:" + number(key.value));
        if (key.value == 0) break;
    }
    frames.change(end, visible, hidden);
    if (is_first) {
        frames.change(clock.fade(), hidden + ";opacity:0", visible + ";opacity:1");
        frames.add(clock.total(), visible + ";opacity:1");
    } else {
        frames.add(clock.total(), hidden + ";opacity:0");
    }
    return frames.text(fmt::format("g{}", i));
}

/// Key frames for the appearance of a stage's tiles.
std::string tile_frames(const Division& division, std::size_t i, const DivisionClock& clock,
                        const Placement& placement) {
    const DivisionStage& stage = division.stages[i];
    const DivisionTracks& tracks = division_tracks(stage.kind);
    CssFrames frames(clock.total());
    const auto time = [&](double share) { return clock.begin(static_cast<int>(i)) + share * clock.times().division; };
    for (const Keyframe& key : tracks.size) frames.add(time(key.at), "scale:" + number(key.value));
    for (const Keyframe& key : tracks.way) {
        frames.add(time(key.at),
                   fmt::format("translate:calc(var(--u)*{0}px) calc(var(--v)*{0}px)", number(key.value)));
    }
    if (stage.kind != DivisionKind::cut) {
        for (const Keyframe& key : tracks.opacity) frames.add(time(key.at), "opacity:" + number(key.value));
    }
    for (const Keyframe& key : tracks.colour) {
        if (key.value > 0 && key.value < 1) continue;
        frames.add(time(key.at), key.value > 0 ? "fill:inherit" : "fill:var(--p)");
    }
    if (stage.outline) {
        const double width = outline_width(division, stage, placement);
        for (const Keyframe& key : tracks.outline)
            frames.add(time(key.at), "stroke-width:" + number(width * key.value));
    }
    return frames.text(fmt::format("t{}", i));
}

std::string line_frames(const Division& division, std::size_t i, const DivisionClock& clock) {
    CssFrames frames(clock.total());
    for (const Keyframe& key : division_tracks(division.stages[i].kind).arrival) {
        frames.add(clock.begin(static_cast<int>(i)) + key.at * clock.times().division,
                   "opacity:" + number(key.value));
    }
    return frames.text(fmt::format("l{}", i));
}

/// Class of a tile by the colour of its parent.
std::string parent_class(Colour colour) {
    return "p" + css(colour).substr(1);
}

}  // namespace

Placement stage_placement(const DivisionStage& stage, const Placement& placement) {
    const glm::dmat2x2 turn(placement.to_page[0], placement.to_page[1]);
    return {{turn * stage.place[0], turn * stage.place[1], turn * stage.place[2] + placement.to_page[2]},
            placement.step * stage.scale};
}

PartMotion stage_motion(const Division& division, std::size_t i, const Placement& placement) {
    const DivisionStage& stage = division.stages[i];
    PartMotion motion;
    motion.part =
        fmt::format(" class=\"g g{}\"{}", i, i + 1 < division.stages.size() ? " visibility=\"hidden\"" : "");
    motion.polygons = fmt::format(" class=\"t t{}\"", i);
    motion.lines = fmt::format(" class=\"l l{}\"", i);
    if (stage.outline) {
        const Colour colour = division.style.line_colour(*stage.outline);
        motion.polygons += fmt::format(
            " stroke=\"{}\"{} stroke-width=\"{}\" stroke-linejoin=\"round\"", hex(colour),
            colour.alpha == 255 ? "" : fmt::format(" stroke-opacity=\"{}\"", number(colour.alpha / 255.0)),
            number(outline_width(division, stage, placement)));
    }
    const MicrometrePlacement place(stage_placement(stage, placement));
    for (std::size_t k = 0; k < stage.tiles.size(); ++k) {
        if (stage.colours[k].alpha == 0) continue;  // not drawn
        if (i == 0) {
            motion.each.emplace_back();
            continue;
        }
        const DivisionStage::Part& part = stage.parts[k];
        const Micrometres middle = place(part.middle);
        const Micrometres end = place(part.middle + part.way);
        motion.each.push_back(fmt::format("class=\"{}\" style=\"transform-origin:{}px {}px;--u:{};--v:{}\" ",
                                          parent_class(part.from), middle.x, middle.y, end.x - middle.x,
                                          end.y - middle.y));
    }
    return motion;
}

std::string division_style(const Division& division, const DivisionClock& clock, const Placement& placement) {
    std::string text = fmt::format(".g, .t path, .l {{ animation: {}s cubic-bezier(.3333,0,.6667,1) infinite }}\n",
                                   decimal(clock.total(), 3));
    std::set<std::string> colours;
    for (std::size_t i = 0; i < division.stages.size(); ++i) {
        const DivisionStage& stage = division.stages[i];
        text += fmt::format(".g{} {{ animation-name: g{} }}\n", i, i) + stage_frames(division, i, clock);
        if (i == 0) continue;
        text +=
            fmt::format(".t{} path {{ animation-name: t{} }}\n", i, i) + tile_frames(division, i, clock, placement);
        if (stage.has_more_lines) {
            text += fmt::format(".l{} {{ animation-name: l{} }}\n", i, i) + line_frames(division, i, clock);
        }
        for (const DivisionStage::Part& part : stage.parts) {
            colours.insert(fmt::format(".{} {{ --p: {} }}\n", parent_class(part.from), css(part.from)));
        }
    }
    for (const std::string& colour : colours) text += colour;
    return text + "@media (prefers-reduced-motion: reduce) { .g, .t path, .l { animation: none } }\n";
}

}  // namespace sikku
