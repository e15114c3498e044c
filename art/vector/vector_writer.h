// art/vector/vector_writer.h: the common base of the SVG, PDF and EPS writers: layers, and strokes split where the
// pen changes.
#pragma once

#include "art/print/micrometres.h"
#include "art/print/print.h"
#include "engine/base/output.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Layers in drawing order: polygons, then the strokes of each colour, then the discs of each colour.
enum class LayerKind { polygons, strokes, discs };
using LayerOrder = std::pair<LayerKind, int>;

/// State of a layer, common to all formats.
struct VectorLayer {
    TextBuffer text;
    bool to_file = false;       ///< the text is written to the file at once, instead of waiting in memory
    std::uint64_t flushed = 0;  ///< bytes of the text that were written to the file
    bool path_open = false;     ///< strokes are being added to a path
    std::string width;          ///< width of lines set last
    std::optional<Colour> run;  ///< colour of polygons or discs set last
};

/// Splits strokes into pieces with one pen each, and pieces into blocks of points, which the format writes.
template <class Layer, class Base = PrintWriter>
class VectorWriter : public Base {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) final {
        here_ = place_(start);
        started_ = false;
        whole_ = true;
        take(pen);
    }
    void change_pen(const Pen& pen) final {
        if (pen_ == pen || (slot_of(pen) == slot_ && width_text(pen) == width_)) return;
        end_piece(false);
        take(pen);
    }
    void lines(std::span<const glm::dvec2> ends) final {
        in_blocks(ends, block_points, [this](std::span<const glm::dvec2> block) { write_lines(block); });
    }
    void curves(std::span<const glm::dvec2> controls) final {
        in_blocks(controls, 3 * (block_points / 4),
                  [this](std::span<const glm::dvec2> block) { write_curves(block); });
    }
    void end_stroke(bool closed) final { end_piece(closed && whole_); }
    std::uint64_t polygons() const final { return polygons_; }

    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) final {
        const Colour colour = part_->style.fill_colour(pen);
        if (colour.alpha == 0 || vertices.size() < 3) return;
        ++polygons_;
        write_polygon(vertices, colour);
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) final {
        const Colour colour = part_->style.fill_colour(pen);
        if (colour.alpha > 0 && outline.size() >= 4) write_area(outline, colour);
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) final {
        const Colour colour = part_->style.fill_colour(pen);
        const double millimetres = part_->style.disc_radius(radius, pen, part_->placement.step);
        if (colour.alpha == 0 || !(millimetres > 0.0)) return;
        write_disc(place_(centre), millimetres * 1000.0, colour,
                   fill_slots_[static_cast<std::size_t>(part_->style.index(pen))]);
    }

protected:
    static constexpr std::size_t block_points = 1024;
    static constexpr std::size_t flush_bytes = std::size_t{1} << 18;

    VectorWriter(const Print& print, Output& file)
        : print_(print),
          file_(file),
          part_(&print),
          window_{0.0, 0.0, print.page.width, print.page.height, false},
          place_(print.placement),
          line_slots_(print.style.line_slots()),
          fill_slots_(print.style.fill_slots()) {}

    /// Continues with the drawings of `part`, once the layers of the previous part have been written.
    void take_part(const Print& part, const Window& window) {
        part_ = &part;
        window_ = window;
        place_ = MicrometrePlacement(part.placement);
        line_slots_ = part.style.line_slots();
        fill_slots_ = part.style.fill_slots();
        layers_.clear();
        layer_ = nullptr;
        pen_.reset();
    }

    /// Begins the layers of a part. The first one of all is written to the file at once; the others wait in memory,
    /// as they may have to precede it.
    void begin_layers() {
        body_begin_ = file_.size();
        streaming_ = false;
    }
    void take_layer(Layer& layer) {
        layer.to_file = layers_.size() == 1 && file_.can_insert();
        streaming_ = streaming_ || layer.to_file;
    }
    /// Passes on the text of a layer when there is enough of it.
    virtual void flush(Layer& layer) {
        if (!layer.to_file || layer.text.size() < flush_bytes) return;
        file_.write(layer.text.view());
        layer.flushed += layer.text.size();
        layer.text.clear();
    }
    /// Writes the layers of a part in their order, each after `end(layer)`.
    template <class End>
    void write_layers(End&& end) {
        std::string before;
        for (auto& [order, layer] : layers_) {
            end(layer);
            streaming_ = streaming_ && !layer.to_file;
            if (streaming_) {
                before.append(layer.text.view());
            } else {
                file_.write(layer.text.view());
            }
        }
        if (!before.empty()) file_.insert(body_begin_, before);
        layers_.clear();
    }

    static std::string label_of(LayerOrder order, Colour colour) {
        if (order.first == LayerKind::polygons) return "fills";
        return (order.first == LayerKind::discs ? "discs" : std::to_string(order.second + 1)) + " " +
               colour_name(colour);
    }

    /// Ends the piece drawn with the current pen, if any.
    void end_piece(bool closed) {
        if (!started_) return;
        write_end(closed && drawn_);
        started_ = false;
        whole_ = false;
    }

    const Print& print_;  ///< the whole sheet
    Output& file_;
    const Print* part_;  ///< the sheet itself, or the part passed to begin_part()
    Window window_;      ///< window of the part
    MicrometrePlacement place_;
    std::map<LayerOrder, Layer> layers_;

    // The current stroke, and its piece with the current pen.
    Layer* layer_ = nullptr;  ///< null until something is drawn with this pen
    int slot_ = 0;
    Colour colour_;
    std::string width_;   ///< micrometres
    bool drawn_ = false;  ///< the piece has length
    Micrometres here_;

private:
    /// The layer of slot_, created if necessary.
    virtual Layer& stroke_layer() = 0;
    /// Puts the pen down at here_.
    virtual void write_start() = 0;
    /// Append a block to the layer and leave here_ at its end. Points that round to the same place are merged.
    virtual void write_lines(std::span<const glm::dvec2> ends) = 0;
    virtual void write_curves(std::span<const glm::dvec2> controls) = 0;
    /// Called after each block with its points and bytes; may end the piece, which then continues as another.
    virtual void end_block(std::size_t points, std::size_t bytes) = 0;
    /// Ends the piece; one without length is a dot.
    virtual void write_end(bool closed) = 0;
    virtual void write_polygon(std::span<const glm::dvec2> vertices, Colour colour) = 0;
    virtual void write_area(std::span<const glm::dvec2> outline, Colour colour) = 0;
    virtual void write_disc(Micrometres centre, double radius, Colour colour, int slot) = 0;

    int slot_of(const Pen& pen) const { return line_slots_[static_cast<std::size_t>(part_->style.index(pen))]; }

    std::string width_text(const Pen& pen) const {
        return decimal(part_->style.line_width(pen, part_->placement.step) * 1000.0, 3);
    }

    void take(const Pen& pen) {
        if (pen_ == pen) return;
        pen_ = pen;
        slot_ = slot_of(pen);
        width_ = width_text(pen);
        colour_ = part_->style.line_colour(pen);
        // In PDF a width of 0 is the thinnest possible line, not an invisible one.
        visible_ = part_->style.draws(pen) && width_ != "0";
        layer_ = nullptr;
    }

    template <class Write>
    void in_blocks(std::span<const glm::dvec2> points, std::size_t most, Write&& write) {
        if (!visible_) {
            whole_ = false;
            here_ = place_(points.back());
            return;
        }
        while (!points.empty()) {
            start_piece();
            const auto block = points.first(std::min(points.size(), most));
            points = points.subspan(block.size());
            const std::size_t before = layer_->text.size();
            write(block);
            const std::size_t bytes = layer_->text.size() - before;
            drawn_ = drawn_ || bytes > 0;
            end_block(block.size(), bytes);
        }
    }

    /// Called only when something is drawn: a pen that is changed twice at one place leaves no dot.
    void start_piece() {
        if (started_) return;
        started_ = true;
        drawn_ = false;
        if (!layer_) layer_ = &stroke_layer();
        write_start();
    }

    std::uint64_t body_begin_ = 0;  ///< position at which the layers of the part begin
    bool streaming_ = false;        ///< a layer of the part went to the file
    std::vector<int> line_slots_;
    std::vector<int> fill_slots_;
    std::optional<Pen> pen_;
    bool visible_ = false;
    bool started_ = false;  ///< the pen is down
    bool whole_ = true;     ///< the stroke is one piece so far, and nothing of it is hidden
    std::uint64_t polygons_ = 0;
};

}  // namespace sikku
