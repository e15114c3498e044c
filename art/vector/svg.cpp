#include "art/vector/svg.h"

#include "art/vector/vector_writer.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/contours.h"
#include "engine/geometry/polygon_classes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// libxml2, and with it xmllint and rsvg, refuses attributes of 10 MB, and also 10 MB of text if its buffer never
/// ends where an element begins, about one chance in eight. So a file begins with long paths and continues with short
/// ones.
constexpr std::uint64_t most_path_bytes = 3'900'000;
constexpr std::uint64_t long_path_region = 3'000'000;
constexpr std::uint64_t late_path_bytes = 32'000;
/// The first strokes of a layer are paths of their own, so that they can be selected one by one; among very many the
/// short ones share paths of about this size.
constexpr int single_strokes = 256;
constexpr std::uint64_t shared_path_bytes = 4096;

/// ` name="0.5"`, or nothing for an opaque colour.
std::string opacity(std::string_view name, Colour colour) {
    return colour.alpha == 255 ? "" : fmt::format(" {}=\"{}\"", name, decimal(colour.alpha / 255.0, 4));
}

/// Writes a command letter if it differs from the last one; else the separator that the next number needs.
inline char* put_command(char* out, char letter, char& last, std::int32_t value) {
    if (letter != last) {
        *out++ = last = letter;
    } else if (value >= 0) {
        *out++ = ' ';
    }
    return put_number(out, value);
}

inline char* put_next(char* out, std::int32_t value) {
    if (value >= 0) *out++ = ' ';
    return put_number(out, value);
}

constexpr std::size_t line_room = 1 + 2 * number_room;
constexpr std::size_t curve_room = 1 + 6 * number_room;

/// Path data from point to point. The letters are those of relative commands; differences of rounded positions
/// do not drift.
class PathData {
public:
    explicit PathData(Micrometres start) : here_(start) {}

    void line(char*& out, Micrometres next) {
        const std::int32_t right = next.x - here_.x;
        const std::int32_t down = next.y - here_.y;
        here_ = next;
        if (down == 0) {
            if (right != 0) out = put_command(out, 'h', command_, right);
        } else if (right == 0) {
            out = put_command(out, 'v', command_, down);
        } else {
            out = put_command(out, 'l', command_, right);
            out = put_next(out, down);
        }
    }

    void curve(char*& out, Micrometres first, Micrometres second, Micrometres end) {
        if (first == here_ && second == here_ && end == here_) return;
        out = put_command(out, 'c', command_, first.x - here_.x);
        out = put_next(out, first.y - here_.y);
        for (const Micrometres point : {second, end}) {
            out = put_next(out, point.x - here_.x);
            out = put_next(out, point.y - here_.y);
        }
        here_ = end;
    }

    Micrometres here() const { return here_; }

private:
    Micrometres here_;
    char command_ = 0;
};

/// Length of a curve, by eight chords.
double curve_length(const Bezier& b) {
    double length = 0;
    glm::dvec2 at = b[0];
    for (int k = 1; k <= 8; ++k) {
        const glm::dvec2 next = point_of(b, k / 8.0);
        length += glm::length(next - at);
        at = next;
    }
    return length;
}

struct SvgLayer : VectorLayer {
    std::uint64_t path_begin = 0;  ///< position() of the open path's attribute d
    std::string path_width;        ///< stroke-width of the open path
    Micrometres at;                ///< end of the open path
    int strokes = 0;

    std::uint64_t position() const { return flushed + text.size(); }
};

/// Makes the pieces of lines drawn by hand appear.
constexpr std::string_view falling =
    ".f { animation: fall 1ms linear calc(var(--b) * var(--pace)) backwards }\n"
    "@keyframes fall { from { visibility: hidden } }\n"
    "@media (prefers-reduced-motion: reduce) { .f { animation: none } }\n";

/// Shows the steps of a lesson one after the other and draws their new lines.
constexpr std::string_view lesson_style =
    ".s { visibility: hidden; animation: step var(--step) linear calc(var(--i) * var(--step)) }\n"
    ".w { animation: wait calc(var(--i) * var(--step)) linear }\n"
    ".n { animation: draw var(--drawing) linear calc(var(--i) * var(--step)) backwards }\n"
    "@keyframes step { from, to { visibility: visible } }\n"
    "@keyframes wait { from, to { visibility: hidden } }\n"
    "@keyframes draw { from { stroke-dasharray: 1 2; stroke-dashoffset: 1.001 } "
    "to { stroke-dasharray: 1 2; stroke-dashoffset: 0 } }\n"
    "@media (prefers-reduced-motion: reduce) { .s, .w, .n { animation: none } }\n";

class SvgWriter final : public VectorWriter<SvgLayer> {
public:
    SvgWriter(const Print& print, Output& file) : VectorWriter(print, file) {
        write_head();
        written_ = file_.size();
        begin_layers();
    }

    void begin_part(const Print& part, const Window& window) override {
        end_part();
        ++parts_;
        const std::string box =
            fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", decimal(window.left, 4),
                        decimal(window.top, 4), decimal(window.width, 4), decimal(window.height, 4));
        if (window.clips) file_.write(fmt::format("<clipPath id=\"window{}\"><rect {}/></clipPath>\n", parts_, box));
        file_.write(fmt::format(
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\"{}{}{}>\n<title>{}</title>\n",
            xml_escaped(part.title), window.clips ? fmt::format(" clip-path=\"url(#window{})\"", parts_) : "",
            step_class(part.lesson), part.motion ? part.motion->part : "", xml_escaped(part.title)));
        moved_ = 0;
        write_ground(part.style.ground, box);
        take_part(part, window);
        begin_layers();
    }

    void finish() override {
        end_part();
        if (print_.animation) write_animation();
        if (lesson_) write_lesson();
        if (!print_.style_sheet.empty()) file_.write("<style>\n" + print_.style_sheet + "</style>\n");
        file_.write("</svg>\n");
    }

private:
    void end_part() {
        write_layers([](SvgLayer& layer) {
            end_path(layer);
            if (layer.run) layer.text.append("</g>\n");
            layer.text.append("</g>\n");
        });
        if (parts_ > 0) file_.write("</g>\n");
    }

    static char* put_text(char* out, std::string_view text) {
        std::memcpy(out, text.data(), text.size());
        return out + text.size();
    }

    void write_head() {
        const std::string width = decimal(print_.page.width, 4);
        const std::string height = decimal(print_.page.height, 4);
        file_.write(
            fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" xmlns:sikku=\"{}\"\n"
                        "     width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\"{}>\n",
                        svg_name_space, width, height, width, height, shown_ground()));
        file_.write(fmt::format("<title>{}</title>\n<desc>", xml_escaped(print_.title)));
        file_.write(xml_escaped(print_.pattern));
        file_.write(fmt::format("</desc>\n<metadata>\n<sikku:made>{}</sikku:made>\n", xml_escaped(print_.made)));
        if (!fits_xml(print_.pattern)) {
            file_.write(fmt::format("<sikku:pattern>{}</sikku:pattern>\n", to_hex(print_.pattern)));
        }
        file_.write("</metadata>\n");
        if (!print_.is_plot) {
            write_ground(print_.style.ground, fmt::format("width=\"{}\" height=\"{}\"", width, height));
        }
    }

    /// The ground of a plot is only a background: plotter software would draw the outline of a rectangle.
    std::string shown_ground() const {
        const std::optional<Colour>& ground = print_.style.ground;
        if (!print_.is_plot || !ground || ground->alpha == 0) return "";
        return fmt::format(" style=\"background:{}\"", hex(*ground));
    }

    void write_ground(const std::optional<Colour>& ground, std::string_view box) {
        if (!ground || ground->alpha == 0) return;
        file_.write(
            fmt::format("<g inkscape:groupmode=\"layer\" inkscape:label=\"ground\">\n"
                        "<rect {} fill=\"{}\"{}/>\n</g>\n",
                        box, hex(*ground), opacity("fill-opacity", *ground)));
    }

    /// Paths contain their beginning and length in millimetres; the pace is written here, when all are known. Viewers
    /// without animation show the whole drawing.
    void write_animation() {
        file_.write(
            fmt::format("<style>\n:root {{ --pace: {}s }}\n"
                        "path[pathLength] {{ animation: draw calc(var(--l) * var(--pace)) linear "
                        "calc(var(--b) * var(--pace)) backwards }}\n"
                        "@keyframes draw {{ from {{ stroke-dasharray: 1 2; stroke-dashoffset: 1.001 }} "
                        "to {{ stroke-dasharray: 1 2; stroke-dashoffset: 0 }} }}\n"
                        "@media (prefers-reduced-motion: reduce) {{ path[pathLength] {{ animation: none }} }}\n"
                        "{}</style>\n",
                        decimal(*print_.animation / std::max(drawn_length_, 1e-3), 9), has_falling_ ? falling : ""));
    }

    /// The step that a part is, and the class of its group: `s`, visible for a while, or `w`, the last, which stays.
    std::string step_class(const std::optional<LessonPart>& lesson) {
        if (!lesson) return "";
        lesson_ = lesson;
        return fmt::format(" class=\"{}\" style=\"--i:{}\"", lesson->number + 1 < lesson->of ? 's' : 'w',
                           lesson->number);
    }

    /// Viewers without animation show the last step.
    void write_lesson() {
        file_.write(fmt::format("<style>\n:root {{ --step: {}s; --drawing: {}s }}\n{}</style>\n",
                                decimal(lesson_->seconds, 3), decimal(lesson_->drawing, 3), lesson_style));
    }

    bool is_new_line() const {
        return part_->lesson && slot_ >= part_->lesson->first_new && slot_ <= part_->lesson->last_new;
    }

    /// The layer of that order, begun with its group on first use. @param attributes  returns those of the group
    template <typename Attributes>
    SvgLayer& open_layer(LayerOrder order, Colour colour, Attributes&& attributes) {
        const auto [found, is_new] = layers_.try_emplace(order);
        SvgLayer& layer = found->second;
        if (!is_new) return layer;
        take_layer(layer);
        const PartMotion* motion = part_->motion;
        const std::string_view moves = !motion                              ? std::string_view()
                                       : order.first == LayerKind::polygons ? std::string_view(motion->polygons)
                                                                            : std::string_view(motion->lines);
        layer.text.append(
            fmt::format("<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" "
                        "transform=\"scale(0.001)\"{}{}>\n",
                        name_of(order, colour), attributes(), moves));
        return layer;
    }

    std::string name_of(LayerOrder order, Colour colour) const {
        if (order.first != LayerKind::strokes) return label_of(order, colour);
        if (order.second == print_.travel_colour) return "% travel";
        const auto name = print_.layer_names.find(order.second);
        return name != print_.layer_names.end() ? name->second : label_of(order, colour);
    }

    /// Polygons keep their order whatever their colours, as they may cover each other.
    SvgLayer& polygon_run(Colour colour) {
        SvgLayer& layer = open_layer({LayerKind::polygons, 0}, colour, [] { return ""; });
        if (layer.run != colour) {
            if (layer.run) layer.text.append("</g>\n");
            layer.text.append(group_of(colour));
            layer.run = colour;
        }
        return layer;
    }

    /// The tag that begins a group of polygons. Tiles change their colour often.
    const std::string& group_of(Colour colour) {
        auto found =
            std::find_if(groups_.begin(), groups_.end(), [&](const auto& one) { return one.first == colour; });
        if (found == groups_.end()) {
            constexpr std::size_t most = 64;
            if (groups_.size() == most) groups_.clear();
            found = groups_.emplace(groups_.end(), colour,
                                    fmt::format("<g fill=\"{}\"{}>\n", hex(colour), opacity("fill-opacity", colour)));
        }
        return found->second;
    }

    void write_polygon(std::span<const glm::dvec2> vertices, Colour colour) override {
        SvgLayer& layer = polygon_run(colour);
        const std::string name = print_.names_tiles ? tile_name(vertices, colour)
                                 : part_->motion    ? part_->motion->each.at(moved_++)
                                                    : "";
        char* out = layer.text.room((vertices.size() + 1) * line_room + 32 + name.size());
        const MicrometrePlacement place = place_;
        const Micrometres start = place(vertices.front());
        out = put_text(out, "<path ");
        out = put_text(out, name);
        out = put_text(out, "d=\"M");
        out = put_number(out, start.x);
        out = put_next(out, start.y);
        PathData path(start);
        for (const glm::dvec2 vertex : vertices.subspan(1)) path.line(out, place(vertex));
        out = put_text(out, "z\"/>\n");
        layer.text.filled_to(out);
        flush(layer);
    }

    /// Identifier and classes of a polygon, numbered from 1 in the order of the drawing.
    std::string tile_name(std::span<const glm::dvec2> vertices, Colour colour) {
        const PolygonClass found = tile_classes_.classify(vertices);
        const auto [at, is_new] = tile_colours_.try_emplace(hex(colour), tile_colours_.size() + 1);
        return fmt::format("id=\"t{}\" class=\"shape-{}{} direction-{} colour-{}\" ", ++tiles_, found.shape + 1,
                           found.is_reflected ? " reflected" : "", found.direction + 1, at->second);
    }

    void write_area(std::span<const glm::dvec2> outline, Colour colour) override {
        SvgLayer& layer = polygon_run(colour);
        // Pieces of lines drawn by hand appear one after the other.
        const bool appears = print_.animation && part_->style.hand > 0;
        char* out = layer.text.room(outline.size() / 3 * curve_room + line_room + 32);
        const MicrometrePlacement place = place_;
        out = put_text(out, "<path d=\"");
        std::optional<PathData> path;
        each_contour(
            outline,
            [&](glm::dvec2 at) {
                const Micrometres start = place(at);
                out = put_text(out, path ? "zM" : "M");
                out = put_number(out, start.x);
                out = put_next(out, start.y);
                path.emplace(start);
            },
            [&](std::span<const glm::dvec2> curve) {
                path->curve(out, place(curve[0]), place(curve[1]), place(curve[2]));
            });
        out = put_text(out, appears ? "z\"" : "z\"/>\n");
        layer.text.filled_to(out);
        if (appears) {
            layer.text.append(fmt::format(" class=\"f\" style=\"--b:{}\"/>\n", decimal(drawn_length_, 3)));
            drawn_length_ += outline_length(outline) / 2;
            has_falling_ = true;
        }
        flush(layer);
    }

    double outline_length(std::span<const glm::dvec2> outline) const {
        double length = 0;
        for (std::size_t i = 3; i < outline.size(); i += 3) {
            length += glm::length(millimetres(place_(outline[i])) - millimetres(place_(outline[i - 3])));
        }
        return length;
    }

    void write_disc(Micrometres centre, double radius, Colour colour, int slot) override {
        SvgLayer& layer = open_layer({LayerKind::discs, slot}, colour, [&] {
            return fmt::format(" fill=\"{}\"{}", hex(colour), opacity("opacity", colour));
        });
        layer.text.append(fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", centre.x, centre.y,
                                      decimal(std::min(radius, 1e9), 1)));
        flush(layer);
    }

    SvgLayer& stroke_layer() override {
        // The opacity is the layer's, so that lines do not darken where they cross or where paths are cut.
        SvgLayer& layer = open_layer({LayerKind::strokes, slot_}, colour_, [&] {
            return fmt::format(
                " fill=\"none\" stroke=\"{}\"{} stroke-width=\"{}\" "
                "stroke-linecap=\"round\" stroke-linejoin=\"round\"",
                hex(colour_), opacity("opacity", colour_), width_);
        });
        if (layer.width.empty()) layer.width = width_;
        return layer;
    }

    void write_start() override {
        if (layer_->path_open &&
            (print_.animation || is_new_line() || layer_->strokes < single_strokes || layer_->path_width != width_ ||
             layer_->position() - layer_->path_begin > shared_path_bytes)) {
            end_path(*layer_);
        }
        if (layer_->path_open) {
            char* out = layer_->text.room(line_room);
            *out++ = 'm';
            out = put_number(out, here_.x - layer_->at.x);
            out = put_next(out, here_.y - layer_->at.y);
            layer_->text.filled_to(out);
        } else {
            layer_->text.append(width_ == layer_->width ? "<path d=\""
                                                        : fmt::format("<path stroke-width=\"{}\" d=\"", width_));
            layer_->path_open = true;
            layer_->path_begin = layer_->position();
            layer_->path_width = width_;
            char* out = layer_->text.room(line_room);
            *out++ = 'M';
            out = put_number(out, here_.x);
            out = put_next(out, here_.y);
            layer_->text.filled_to(out);
        }
        piece_start_ = here_;
        piece_length_ = 0;
        data_ = PathData(here_);
    }

    void write_lines(std::span<const glm::dvec2> ends) override {
        char* out = layer_->text.room(ends.size() * line_room);
        // Local copies: the compiler can rely on writing text not to change them.
        PathData path = data_;
        const MicrometrePlacement place = place_;
        for (const glm::dvec2 point : ends) path.line(out, place(point));
        if (print_.animation) add_lines(ends);
        data_ = path;
        here_ = path.here();
        layer_->text.filled_to(out);
    }

    void write_curves(std::span<const glm::dvec2> controls) override {
        char* out = layer_->text.room(controls.size() / 3 * curve_room);
        PathData path = data_;
        const MicrometrePlacement place = place_;
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            path.curve(out, place(controls[i]), place(controls[i + 1]), place(controls[i + 2]));
        }
        if (print_.animation) add_curves(controls);
        data_ = path;
        here_ = path.here();
        layer_->text.filled_to(out);
    }

    void end_block(std::size_t, std::size_t bytes) override {
        written_ += bytes;
        flush(*layer_);
        const std::uint64_t path_bytes = layer_->position() - layer_->path_begin;
        if (path_bytes > most_path_bytes ||
            (path_bytes > late_path_bytes && written_ - path_bytes > long_path_region)) {
            end_piece(false);
            end_path(*layer_);
        }
    }

    void write_end(bool closed) override {
        // A line without length: the round caps make it a dot.
        if (!drawn_) layer_->text.append("h0");
        if (closed) layer_->text.append("z");
        layer_->at = closed ? piece_start_ : here_;
        ++layer_->strokes;
        if (print_.animation && layer_->path_open) {
            if (closed) piece_length_ += glm::length(millimetres(piece_start_) - millimetres(here_));
            layer_->text.append(fmt::format("\" pathLength=\"1\" style=\"--b:{};--l:{}\"/>\n",
                                            decimal(drawn_length_, 3), decimal(piece_length_, 3)));
            layer_->path_open = false;
            drawn_length_ += piece_length_;
        } else if (is_new_line() && layer_->path_open) {
            layer_->text.append("\" pathLength=\"1\" class=\"n\"/>\n");
            layer_->path_open = false;
        }
    }

    static void end_path(SvgLayer& layer) {
        if (layer.path_open) layer.text.append("\"/>\n");
        layer.path_open = false;
    }

    static glm::dvec2 millimetres(Micrometres point) { return glm::dvec2(point.x, point.y) / 1000.0; }

    void add_lines(std::span<const glm::dvec2> ends) {
        glm::dvec2 at = millimetres(here_);
        for (const glm::dvec2 end : ends) {
            const glm::dvec2 next = millimetres(place_(end));
            piece_length_ += glm::length(next - at);
            at = next;
        }
    }
    void add_curves(std::span<const glm::dvec2> controls) {
        glm::dvec2 at = millimetres(here_);
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const Bezier bezier = {at, millimetres(place_(controls[i])), millimetres(place_(controls[i + 1])),
                                   millimetres(place_(controls[i + 2]))};
            piece_length_ += curve_length(bezier);
            at = bezier[3];
        }
    }

    std::uint64_t written_ = 0;  ///< bytes of the head and of path data, of all layers
    int parts_ = 0;
    std::optional<LessonPart> lesson_;  ///< the last one
    bool has_falling_ = false;          ///< pieces of lines drawn by hand
    double piece_length_ = 0.0;         ///< length of the open piece, in millimetres
    double drawn_length_ = 0.0;         ///< length of all animated pieces so far
    std::int64_t tiles_ = 0;            ///< polygons with names
    std::size_t moved_ = 0;             ///< polygons of a part that moves
    PolygonClasses tile_classes_;
    std::vector<std::pair<Colour, std::string>> groups_;
    std::map<std::string, std::size_t> tile_colours_;  ///< numbers of their colours, from 1
    Micrometres piece_start_;
    PathData data_{Micrometres{}};
};

}  // namespace

std::unique_ptr<PrintWriter> write_svg(const Print& print, Output& file) {
    return std::make_unique<SvgWriter>(print, file);
}

}  // namespace sikku
