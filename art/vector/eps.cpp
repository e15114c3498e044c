#include "art/vector/eps.h"

#include "art/print/recipe_comments.h"
#include "art/vector/vector_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace sikku {
namespace {

constexpr double points_of_micrometre = 72.0 / 25400.0;
constexpr std::size_t flush_bytes = std::size_t{1} << 18;
/// Printers of level 2 support paths of 1,500 points. Cuts in lines are invisible, as caps are round and everything
/// is opaque.
constexpr int most_path_points = 1000;
constexpr std::size_t block_of_points = 512;
/// Distance of the control points of a quarter circle's Bézier from its ends, in radii.
constexpr double quarter_circle = 0.5522847498307936;

inline char* put_point(char* out, Micrometres point) {
    out = put_number(out, point.x);
    *out++ = ' ';
    out = put_number(out, point.y);
    *out++ = ' ';
    return out;
}
inline char* put_operator(char* out, char name) {
    *out++ = name;
    *out++ = '\n';
    return out;
}
constexpr std::size_t point_room = 2 * number_room + 2;
constexpr std::size_t line_room = point_room + 2;
constexpr std::size_t curve_room = 3 * point_room + 2;

/// A text of a comment: printable ASCII, at most 200 characters.
std::string comment_text(std::string_view text) {
    std::string result(text.substr(0, 200));
    std::replace_if(
        result.begin(), result.end(), [](char byte) { return byte < 0x20 || byte >= 0x7F; }, '?');
    return result;
}

struct Layer : VectorLayer {
    int points = 0;  ///< points of the open path
};

void end_path(Layer& layer) {
    if (layer.path_open) layer.text.append("S\n");
    layer.path_open = false;
    layer.points = 0;
}

class Writer final : public VectorWriter<Layer> {
public:
    Writer(const Print& print, Output& file) : VectorWriter(print, file) {
        write_head();
        write_ground(print.style.ground, window_);
        body_begin_ = file_.size();
    }

    void begin_part(const Print& part, const Window& window) override {
        end_part();
        take_part(part, window);
        file_.write(fmt::format("gsave % {}\n", comment_text(part.title)));
        if (window.clips) file_.write(rectangle(window) + " rectclip\n");
        has_part_ = true;
        write_ground(part.style.ground, window);
        body_begin_ = file_.size();
        streaming_ = false;
    }

    void finish() override {
        end_part();
        file_.write("grestore end\nshowpage\n%%Trailer\n%%EOF\n");
    }

private:
    void write_head() {
        const double width = print_.page.width * 1000.0 * points_of_micrometre;
        const double height = print_.page.height * 1000.0 * points_of_micrometre;
        file_.write(fmt::format("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 {} {}\n%%HiResBoundingBox: 0 0 {} {}\n",
                                static_cast<std::int64_t>(std::ceil(width)),
                                static_cast<std::int64_t>(std::ceil(height)), decimal(width, 4), decimal(height, 4)));
        if (!print_.title.empty()) file_.write(fmt::format("%%Title: {}\n", comment_text(print_.title)));
        file_.write("%%Creator: Sikku\n%%LanguageLevel: 2\n%%DocumentData: Clean7Bit\n%%EndComments\n");
        for (const std::string& piece : recipe_comments(print_.pattern, print_.made)) file_.write("%" + piece + "\n");
        file_.write(
            "%%BeginProlog\n/SikkuDict 16 dict def SikkuDict begin\n/m /moveto load def /l /lineto load def\n"
            "/c /curveto load def /h /closepath load def\n/S /stroke load def /f /fill load def\n"
            "/w /setlinewidth load def /k /setrgbcolor load def\nend\n%%EndProlog\n");
        const std::string scale = decimal(points_of_micrometre, 14);
        file_.write(fmt::format(
            "SikkuDict begin gsave\n0 0 {0} {1} rectclip\n[{2} 0 0 -{2} 0 {1}] concat\n1 setlinejoin 1 setlinecap\n",
            decimal(width, 4), decimal(height, 4), scale));
    }

    static std::string rectangle(const Window& window) {
        return fmt::format("{} {} {} {}", decimal(window.left * 1000, 1), decimal(window.top * 1000, 1),
                           decimal(window.width * 1000, 1), decimal(window.height * 1000, 1));
    }

    void write_ground(const std::optional<Colour>& ground, const Window& window) {
        if (!ground || ground->alpha == 0) return;
        // Beneath the ground of a part lies that of the sheet.
        const Colour beneath = part_ == &print_ ? white : mixed(print_.style.ground.value_or(white), white);
        paper_ = mixed(*ground, beneath);
        file_.write(fmt::format("% ground\n{} {} rectfill\n", set(paper_), rectangle(window)));
    }

    static Colour mixed(Colour colour, Colour beneath) {
        const auto channel = [&](std::uint8_t over, std::uint8_t under) {
            return static_cast<std::uint8_t>(
                std::lround((over * colour.alpha + under * (255 - colour.alpha)) / 255.0));
        };
        return {channel(colour.red, beneath.red), channel(colour.green, beneath.green),
                channel(colour.blue, beneath.blue), 255};
    }
    /// The operators that set an opaque colour.
    static std::string set(Colour colour) {
        return fmt::format("{} {} {} k", decimal(colour.red / 255.0, 4), decimal(colour.green / 255.0, 4),
                           decimal(colour.blue / 255.0, 4));
    }
    std::string ink(Colour colour) const { return set(mixed(colour, paper_)); }

    /// Writes the layers in their order.
    void end_part() {
        std::string before;
        bool is_behind = streaming_;
        for (auto& [order, layer] : layers_) {
            end_path(layer);
            if (layer.to_file) {
                is_behind = false;
                file_.write(layer.text.view());
            } else if (is_behind) {
                before.append(layer.text.view());
            } else {
                file_.write(layer.text.view());
            }
        }
        if (!before.empty()) file_.insert(body_begin_, before);
        layers_.clear();
        if (has_part_) file_.write("grestore\n");
        has_part_ = false;
        paper_ = mixed(print_.style.ground.value_or(white), white);
    }

    /// The first layer of all is written to the file at once; the others wait in memory, as they may have to precede
    /// it.
    template <typename Label>
    Layer& open_layer(LayerOrder order, Label&& label) {
        const auto [found, is_new] = layers_.try_emplace(order);
        Layer& layer = found->second;
        if (!is_new) return layer;
        layer.to_file = layers_.size() == 1 && file_.can_insert();
        streaming_ = streaming_ || layer.to_file;
        layer.text.append(fmt::format("% {}\n", label()));
        return layer;
    }
    void flush(Layer& layer) {
        if (!layer.to_file || layer.text.size() < flush_bytes) return;
        file_.write(layer.text.view());
        layer.text.clear();
    }

    /// Polygons keep their order whatever their colours, as they may cover each other.
    Layer& polygon_layer(Colour colour) {
        Layer& layer = open_layer({LayerKind::polygons, 0}, [] { return std::string("fills"); });
        if (layer.run != colour) layer.text.append(ink(colour) + "\n");
        layer.run = colour;
        return layer;
    }

    void write_polygon(std::span<const glm::dvec2> vertices, Colour colour) override {
        Layer& layer = polygon_layer(colour);
        const MicrometrePlacement place = place_;
        bool first = true;
        while (!vertices.empty()) {
            const auto block = vertices.first(std::min(vertices.size(), block_of_points));
            vertices = vertices.subspan(block.size());
            char* out = layer.text.room(block.size() * line_room);
            for (const glm::dvec2 vertex : block) {
                out = put_operator(put_point(out, place(vertex)), first ? 'm' : 'l');
                first = false;
            }
            layer.text.filled_to(out);
            flush(layer);
        }
        layer.text.append("f\n");
    }

    void write_area(std::span<const glm::dvec2> outline, Colour colour) override {
        Layer& layer = polygon_layer(colour);
        const MicrometrePlacement place = place_;
        layer.text.filled_to(put_operator(put_point(layer.text.room(line_room), place(outline.front())), 'm'));
        write_bezier_blocks(layer, outline.subspan(1));
        layer.text.append("f\n");
    }
    void write_bezier_blocks(Layer& layer, std::span<const glm::dvec2> controls) {
        const MicrometrePlacement place = place_;
        while (controls.size() >= 3) {
            const auto block = controls.first(std::min(controls.size() / 3, block_of_points) * 3);
            controls = controls.subspan(block.size());
            char* out = layer.text.room(block.size() / 3 * curve_room);
            for (std::size_t i = 0; i + 2 < block.size(); i += 3) {
                for (std::size_t k = i; k < i + 3; ++k) out = put_point(out, place(block[k]));
                out = put_operator(out, 'c');
            }
            layer.text.filled_to(out);
            flush(layer);
        }
    }

    void write_disc(Micrometres centre, double radius, Colour colour, int slot) override {
        Layer& layer =
            open_layer({LayerKind::discs, slot}, [&] { return fmt::format("discs {}", colour_name(colour)); });
        if (!layer.run) layer.text.append(ink(colour) + "\n");
        layer.run = colour;
        const auto at = [&](double x, double y) {
            return Micrometres{to_whole(centre.x + radius * x), to_whole(centre.y + radius * y)};
        };
        constexpr double k = quarter_circle;
        const std::array<std::array<Micrometres, 3>, 4> quarters = {{{at(1, k), at(k, 1), at(0, 1)},
                                                                     {at(-k, 1), at(-1, k), at(-1, 0)},
                                                                     {at(-1, -k), at(-k, -1), at(0, -1)},
                                                                     {at(k, -1), at(1, -k), at(1, 0)}}};
        char* out = layer.text.room(6 * curve_room);
        out = put_operator(put_point(out, at(1, 0)), 'm');
        for (const auto& [first, second, end] : quarters) {
            out = put_operator(put_point(put_point(put_point(out, first), second), end), 'c');
        }
        out = put_operator(out, 'f');
        layer.text.filled_to(out);
        flush(layer);
    }

    Layer& stroke_layer() override {
        return open_layer({LayerKind::strokes, slot_},
                          [&] { return fmt::format("{} {}", slot_ + 1, colour_name(colour_)); });
    }
    void write_start() override {
        if (layer_->width != width_) {
            end_path(*layer_);
            if (layer_->width.empty()) layer_->text.append(ink(colour_) + "\n");
            layer_->text.append(fmt::format("{} w\n", width_));
            layer_->width = width_;
        }
        layer_->path_open = true;
        put(here_, 'm');
    }
    void put(Micrometres point, char name) {
        char* out = layer_->text.room(line_room);
        layer_->text.filled_to(put_operator(put_point(out, point), name));
    }
    void write_lines(std::span<const glm::dvec2> ends) override {
        char* out = layer_->text.room(ends.size() * line_room);
        const MicrometrePlacement place = place_;
        for (const glm::dvec2 point : ends) {
            const Micrometres next = place(point);
            if (next == here_) continue;
            here_ = next;
            out = put_operator(put_point(out, next), 'l');
        }
        layer_->text.filled_to(out);
    }
    void write_curves(std::span<const glm::dvec2> controls) override {
        char* out = layer_->text.room(controls.size() / 3 * curve_room);
        const MicrometrePlacement place = place_;
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const Micrometres first = place(controls[i]), second = place(controls[i + 1]),
                              end = place(controls[i + 2]);
            if (first == here_ && second == here_ && end == here_) continue;
            here_ = end;
            out = put_operator(put_point(put_point(put_point(out, first), second), end), 'c');
        }
        layer_->text.filled_to(out);
    }
    void end_block(std::size_t points, std::size_t) override {
        layer_->points += static_cast<int>(points);
        if (layer_->points > most_path_points) {
            end_piece(false);
            end_path(*layer_);
        }
        flush(*layer_);
    }
    void write_end(bool closed) override {
        // A line without length: the round caps make it a dot.
        if (!drawn_) put(here_, 'l');
        if (closed) layer_->text.append("h\n");
        layer_->points += 1;
        if (layer_->points > most_path_points) end_path(*layer_);
    }

    static constexpr Colour white{255, 255, 255, 255};
    Colour paper_ = white;          ///< colour with which translucent colours are mixed
    std::uint64_t body_begin_ = 0;  ///< position at which the layers of the part begin
    bool streaming_ = false;        ///< a layer of the part went to the file
    bool has_part_ = false;
};

}  // namespace

std::unique_ptr<PrintWriter> write_eps(const Print& print, Output& file) {
    return std::make_unique<Writer>(print, file);
}

}  // namespace sikku
