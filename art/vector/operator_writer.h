// art/vector/operator_writer.h: the common base of the PDF and EPS writers: paths as whole micrometres and operators
// of one letter.
#pragma once

#include "art/vector/vector_writer.h"
#include "engine/geometry/contours.h"

namespace sikku {

constexpr double points_of_micrometre = 72.0 / 25400.0;
/// Distance of the control points of a quarter circle's Bézier from its ends, in radii.
constexpr double quarter_circle = 0.5522847498307936;

struct OperatorLayer : VectorLayer {
    int points = 0;  ///< points of the open path
};

/// Writes m, l, c and h for moves, lines, curves and closing; f and S paint a path; w sets the width of lines.
template <class Layer, class Base = PrintWriter>
class OperatorWriter : public VectorWriter<Layer, Base> {
protected:
    using Writer = VectorWriter<Layer, Base>;
    using Writer::layer_, Writer::here_, Writer::place_, Writer::width_, Writer::colour_, Writer::slot_;

    /// @param most_path_points  points of strokes that are painted at once. Cuts in lines are invisible, as caps are
    /// round and everything is opaque or painted as a group.
    OperatorWriter(const Print& print, Output& file, int most_path_points)
        : Writer(print, file), most_path_points_(most_path_points) {}

    static void end_path(Layer& layer) {
        if (layer.path_open) layer.text.append("S\n");
        layer.path_open = false;
        layer.points = 0;
    }

    /// The layer of that order, in the given colour. Polygons keep their order whatever their colours, as they may
    /// cover each other.
    Layer& layer_in(LayerOrder order, Colour colour) {
        const auto [found, is_new] = this->layers_.try_emplace(order);
        Layer& layer = found->second;
        if (is_new) begin_layer(layer, order, colour);
        if (layer.run != colour) layer.text.append(ink_of(order.first, colour) + '\n');
        layer.run = colour;
        return layer;
    }

private:
    virtual void begin_layer(Layer& layer, LayerOrder order, Colour colour) = 0;
    /// The operators that set the colour of polygons, strokes or discs.
    virtual std::string ink_of(LayerKind kind, Colour colour) = 0;
    /// Called before a polygon, and before an area without vertices.
    virtual void begin_polygon(Layer&, std::span<const glm::dvec2> /*vertices*/, Colour) {}

    static constexpr std::size_t point_room = 2 * number_room + 2;
    static constexpr std::size_t line_room = point_room + 2;
    static constexpr std::size_t curve_room = 3 * point_room + 2;

    static char* put_point(char* out, Micrometres point) {
        out = put_number(out, point.x);
        *out++ = ' ';
        out = put_number(out, point.y);
        *out++ = ' ';
        return out;
    }
    static char* put_operator(char* out, char name) {
        *out++ = name;
        *out++ = '\n';
        return out;
    }
    static char* put_line(char* out, Micrometres point, char name = 'l') {
        return put_operator(put_point(out, point), name);
    }
    static char* put_curve(char* out, Micrometres first, Micrometres second, Micrometres end) {
        return put_operator(put_point(put_point(put_point(out, first), second), end), 'c');
    }
    static void put(Layer& layer, Micrometres point, char name) {
        layer.text.filled_to(put_line(layer.text.room(line_room), point, name));
    }

    void write_polygon(std::span<const glm::dvec2> vertices, Colour colour) override {
        Layer& layer = layer_in({LayerKind::polygons, 0}, colour);
        begin_polygon(layer, vertices, colour);
        const MicrometrePlacement place = place_;
        char name = 'm';
        while (!vertices.empty()) {
            const auto block = vertices.first(std::min(vertices.size(), this->block_points));
            vertices = vertices.subspan(block.size());
            char* out = layer.text.room(block.size() * line_room);
            for (const glm::dvec2 vertex : block) out = put_line(out, place(vertex), std::exchange(name, 'l'));
            layer.text.filled_to(out);
            this->flush(layer);
        }
        layer.text.append("f\n");
    }

    void write_area(std::span<const glm::dvec2> outline, Colour colour) override {
        Layer& layer = layer_in({LayerKind::polygons, 0}, colour);
        begin_polygon(layer, {}, colour);
        const MicrometrePlacement place = place_;
        std::size_t curves = 0;
        each_contour(
            outline, [&](glm::dvec2 at) { put(layer, place(at), 'm'); },
            [&](std::span<const glm::dvec2> curve) {
                char* const out = layer.text.room(curve_room);
                layer.text.filled_to(put_curve(out, place(curve[0]), place(curve[1]), place(curve[2])));
                if (++curves % this->block_points == 0) this->flush(layer);
            });
        this->flush(layer);
        layer.text.append("f\n");
    }

    void write_disc(Micrometres centre, double radius, Colour colour, int slot) override {
        Layer& layer = layer_in({LayerKind::discs, slot}, colour);
        const auto at = [&](double x, double y) {
            return Micrometres{to_whole(centre.x + radius * x), to_whole(centre.y + radius * y)};
        };
        constexpr double k = quarter_circle;
        char* out = put_line(layer.text.room(6 * curve_room), at(1, 0), 'm');
        out = put_curve(out, at(1, k), at(k, 1), at(0, 1));
        out = put_curve(out, at(-k, 1), at(-1, k), at(-1, 0));
        out = put_curve(out, at(-1, -k), at(-k, -1), at(0, -1));
        out = put_curve(out, at(k, -1), at(1, -k), at(1, 0));
        layer.text.filled_to(put_operator(out, 'f'));
        this->flush(layer);
    }

    Layer& stroke_layer() override { return layer_in({LayerKind::strokes, slot_}, colour_); }

    void write_start() override {
        if (layer_->width != width_) {
            end_path(*layer_);
            layer_->text.append(width_ + " w\n");
            layer_->width = width_;
        }
        layer_->path_open = true;
        put(*layer_, here_, 'm');
    }

    void write_lines(std::span<const glm::dvec2> ends) override {
        char* out = layer_->text.room(ends.size() * line_room);
        // Local copies: the compiler can rely on writing text not to change them.
        Micrometres here = here_;
        const MicrometrePlacement place = place_;
        for (const glm::dvec2 point : ends) {
            const Micrometres next = place(point);
            if (next == here) continue;
            here = next;
            out = put_line(out, next);
        }
        here_ = here;
        layer_->text.filled_to(out);
    }

    void write_curves(std::span<const glm::dvec2> controls) override {
        char* out = layer_->text.room(controls.size() / 3 * curve_room);
        Micrometres here = here_;
        const MicrometrePlacement place = place_;
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const Micrometres first = place(controls[i]), second = place(controls[i + 1]),
                              end = place(controls[i + 2]);
            if (first == here && second == here && end == here) continue;
            here = end;
            out = put_curve(out, first, second, end);
        }
        here_ = here;
        layer_->text.filled_to(out);
    }

    void end_block(std::size_t points, std::size_t) override {
        layer_->points += static_cast<int>(points);
        if (layer_->points > most_path_points_) {
            this->end_piece(false);
            end_path(*layer_);
        }
        this->flush(*layer_);
    }

    void write_end(bool closed) override {
        // A line without length: the round caps make it a dot.
        if (!this->drawn_) put(*layer_, here_, 'l');
        if (closed) layer_->text.append("h\n");
        layer_->points += 1;
        if (layer_->points > most_path_points_) end_path(*layer_);
    }

    int most_path_points_;
};

}  // namespace sikku
