#include "engine/geometry/space_turtle.h"

#include "engine/geometry/lattice.h"
#include "engine/geometry/lettering.h"
#include "engine/geometry/turtle_state.h"
#include "engine/language/surface.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sikku {
namespace {

// The turtle's own axes.
constexpr glm::dvec3 ahead{1, 0, 0};
constexpr glm::dvec3 leftwards{0, 1, 0};
constexpr glm::dvec3 upwards{0, 0, 1};

constexpr glm::dvec3 vertical{0, 1, 0};  // of the world

glm::dquat rotation(double degrees, const glm::dvec3& axis) {
    // The half angle's cosine and sine, so that quarter turns are as exact as they can be.
    const glm::dvec2 half = unit_vector(degrees / 2);
    return {half.x, half.y * axis.x, half.y * axis.y, half.y * axis.z};
}

glm::dquat rotation(Action action, double degrees) {
    if (action == Action::pitch) return rotation(degrees, leftwards);
    return action == Action::roll ? rotation(-degrees, ahead) : rotation(degrees, upwards);
}

std::uint64_t mixed(std::uint64_t number) {
    return scrambled(number + 0x9e3779b97f4a7c15U);
}

void widen(SpaceBounds& bounds, const glm::dvec3& point) {
    bounds.low = glm::min(bounds.low, point);
    bounds.high = glm::max(bounds.high, point);
}

class WalkingSpaceTurtle final : public SpaceTurtle {
public:
    WalkingSpaceTurtle(const Grammar& grammar, SpaceSink* sink, double sway)
        : sink_(sink),
          sway_(sway),
          tropism_(grammar.tropism()),
          surfaces_(grammar.surfaces()),
          labels_(grammar.labels()),
          letter_height_(grammar.letter_height()),
          edges_(grammar) {
        for (const SymbolInfo& symbol : grammar.symbols()) {
            const Command& command = symbol.command;
            Instruction instruction{.action = command.action,
                                    .value = command.value,
                                    .takes_argument = command.takes_argument,
                                    .is_vertex = command.is_vertex,
                                    .arity = symbol.arity,
                                    .turn = {},
                                    .surface = command.action == Action::label ? command.label : command.surface,
                                    .size = size_of(symbol.arguments),
                                    .arguments = symbol.arguments};
            if (!std::isfinite(command.angle.degrees)) instruction.value = command.angle.degrees;
            if (command.is_turn() && !command.takes_argument) {
                instruction.turn = rotation(command.action, command.angle.degrees);
            }
            commands_.push_back(instruction);
        }
        state_.place.orientation = rotation(grammar.heading().degrees, upwards);
        state_.branch = grammar.seed();
        edges_.start(state_.place);
    }

    void symbols(const Run& run) override {
        const double* next = run.arguments.data();
        for (const Symbol symbol : run.symbols) {
            const Instruction& command = commands_[symbol];
            ++position_;
            if (command.action == Action::surface) {
                place_surface(*surfaces_[command.surface],
                              command.takes_argument ? size_of({next, command.arity}) : command.size);
            } else if (command.action == Action::label) {
                write_label(labels_[command.surface],
                            command.arity > 0 ? std::span(next, command.arity) : std::span(command.arguments));
            } else if (command.action != Action::pass) {
                obey(command, command.takes_argument ? command.value * *next : command.value);
            }
            next += command.arity;
        }
    }

    void finish() override {
        stack_.finish();
        polygons_.finish();
        edges_.finish();
        survey_.end = state_.place.at;
        survey_.closed = Place().same_place(state_.place);
    }

    const SpaceSurvey& survey() const override { return survey_; }

private:
    struct Place {
        glm::dvec3 at{0.0};
        glm::dquat orientation{1, 0, 0, 0};
        bool same_place(const Place& other) const {
            return glm::distance(at, other.at) <= 1e-9 * std::max(1.0, glm::length(at));
        }
    };
    struct Vertex {
        glm::dvec3 at;
        int colour;
    };
    struct State {
        Place place;
        Pen pen;
        Pen before;  ///< the pen of the last segment on the way here
        bool came = false;
        std::size_t node = 0;        ///< of the inserted edges' tree
        std::size_t places = 0;      ///< in it, when the branch began
        std::uint64_t branch = 0;    ///< a number for the branch, from those of its mother and sisters
        std::uint64_t branches = 0;  ///< number of its branches so far
    };
    struct Instruction {
        Action action;
        double value;
        bool takes_argument;
        bool is_vertex;
        std::uint32_t arity;
        glm::dquat turn;
        std::uint32_t surface;          ///< or label
        glm::dvec3 size;                ///< of a surface
        std::vector<double> arguments;  ///< constant ones
    };

    /// The factors of `~X(s)` and `~X(sx,sy,sz)`.
    static glm::dvec3 size_of(std::span<const double> arguments) {
        if (arguments.size() >= 3) return {arguments[0], arguments[1], arguments[2]};
        return glm::dvec3(arguments.empty() ? 1.0 : arguments[0]);
    }

    void obey(const Instruction& command, double value) {
        if (!std::isfinite(value)) throw_at(position_, "its parameter is not finite");
        switch (command.action) {
            case Action::draw:
                draw(value, command.is_vertex);
                break;
            case Action::move:
                step(value, command.is_vertex);
                joined_ = false;
                state_.came = false;
                break;
            case Action::turn:
            case Action::pitch:
            case Action::roll: {
                glm::dquat& orientation = state_.place.orientation;
                orientation = glm::normalize(
                    orientation * (command.takes_argument ? rotation(command.action, value) : command.turn));
                break;
            }
            case Action::level:
                level();
                break;
            case Action::push:
                state_.places = edges_.size();
                ++state_.branches;
                stack_.push(state_, position_);
                if (sway_ > 0 && polygons_.empty()) sway();
                survey_.depth = std::max(survey_.depth, stack_.depth());
                joined_ = false;
                break;
            case Action::pop:
                state_ = stack_.pop(position_);
                edges_.pop(state_.places);
                joined_ = false;
                break;
            case Action::polygon_begin:
                refuse_cylinder(position_, value);
                is_framed_ = !command.is_vertex;
                polygons_.begin(state_.place, command.is_vertex, position_);
                break;
            case Action::polygon_vertex:
                add_vertex();
                break;
            case Action::edge_begin:
                edges_.open(state_.node, position_);
                break;
            case Action::edge_end:
                end_edge();
                break;
            case Action::polygon_end:
                end_polygon();
                break;
            case Action::disc:
                if (sink_) sink_->sphere(state_.place.at, std::fabs(value), state_.pen);
                break;
            default:
                change_pen(state_.pen, command.action, value);
        }
    }

    /// Turns a new branch at random, independently of others, so that it keeps its direction while they grow.
    void sway() {
        state_.branch = mixed(state_.branch + state_.branches);
        state_.branches = 0;
        const auto share = [&](std::uint64_t which) {  // from 0 to 1
            return static_cast<double>(mixed(state_.branch ^ which) >> 11) / 9007199254740992.0;
        };
        const double side = share(1) * 2 * std::numbers::pi;
        const glm::dvec3 axis = leftwards * std::cos(side) + upwards * std::sin(side);
        glm::dquat& orientation = state_.place.orientation;
        orientation = glm::normalize(orientation * rotation(sway_ * std::sqrt(share(2)), axis) *
                                     rotation(sway_ * (2 * share(3) - 1), ahead));
    }

    void draw(double length, bool is_vertex) {
        const glm::dvec3 from = state_.place.at;
        note_ink(from);
        step(length, is_vertex);
        widen(*survey_.ink, state_.place.at);
        ++survey_.drawn;
        survey_.length += std::fabs(length);
        if (sink_)
            sink_->segment(from, state_.came ? state_.before : state_.pen, state_.place.at, state_.pen, joined_);
        state_.before = state_.pen;
        state_.came = joined_ = true;
        if (tropism_) bend(state_.place.at - from);
    }

    void step(double length, bool is_vertex) {
        Place& place = state_.place;
        place.at += length * (place.orientation * ahead);
        if (!(glm::length(place.at) <= 1e300)) {
            throw_at(position_, "the turtle leaves the range of its coordinates");
        }
        ++survey_.moves;
        widen(survey_.box, place.at);
        if (is_vertex) add_vertex();
        edges_.step(place, state_.node, position_);
    }

    void add_vertex() {
        if (polygons_.empty()) return;
        polygons_.add(state_.place, [this](const Place& there) { return Vertex{there.at, state_.pen.colour}; });
    }

    void end_polygon() {
        const std::vector<Vertex> polygon = polygons_.end(position_);
        ++survey_.polygons;
        if (!sink_ || polygon.size() < 3) return;
        std::vector<glm::dvec3> vertices;
        std::vector<int> colours;
        for (const Vertex& vertex : polygon) {
            vertices.push_back(vertex.at);
            colours.push_back(vertex.colour);
        }
        is_framed_ ? sink_->facet(vertices, colours, state_.pen) : sink_->polygon(vertices, state_.pen);
    }

    void place_surface(const Surface& surface, const glm::dvec3& size) {
        const glm::dquat& orientation = state_.place.orientation;
        const glm::dmat3 own(glm::cross(surface.heading, surface.up), surface.heading, surface.up);
        const glm::dmat3 turtle(orientation * -leftwards, orientation * ahead, orientation * upwards);
        glm::dmat3 map = turtle * glm::transpose(own);
        for (int axis = 0; axis < 3; ++axis) map[axis] *= size[axis] / surface.size;
        glm::dvec3& at = state_.place.at;
        const glm::dvec3 origin = at - map * surface.contact, end = origin + map * surface.end;
        if (!(glm::length(end) <= 1e300)) throw_at(position_, "its size is not finite");
        if (sink_) sink_->surface(surface, glm::dmat4x3(map[0], map[1], map[2], origin), state_.pen);
        if (surface.end == surface.contact) return;
        at = end;
        joined_ = state_.came = false;
        widen(survey_.box, at);
        edges_.step(state_.place, state_.node, position_);
    }

    void write_label(const LabelText& label, std::span<const double> arguments) {
        const std::string text = text_at(label, arguments, position_);
        const glm::dvec3 half(text_width(text, letter_height_) / 2, letter_height_ / 2, 0);
        note_ink(state_.place.at - half);
        widen(*survey_.ink, state_.place.at + half);
        if (sink_) sink_->label(text, state_.place.at, letter_height_, state_.pen);
    }

    void end_edge() {
        const std::vector<Place> cycle = edges_.close(state_.node, position_);
        ++survey_.polygons;
        joined_ = false;
        if (!sink_ || cycle.size() < 2) return;
        std::vector<glm::dvec3> vertices;
        for (const Place& place : cycle) vertices.push_back(place.at);
        if (vertices.size() >= 3) sink_->polygon(vertices, state_.pen);
        sink_->segment(vertices.front(), state_.pen, vertices.back(), state_.pen, false);
    }

    void note_ink(const glm::dvec3& point) {
        if (!survey_.ink) survey_.ink = SpaceBounds{point, point};
        widen(*survey_.ink, point);
    }

    void bend(const glm::dvec3& segment) {
        glm::dquat& orientation = state_.place.orientation;
        const glm::dvec3 axis = glm::cross(orientation * ahead, tropism_->force);
        const double size = glm::length(axis);
        if (!(size > 0)) return;
        const double angle = tropism_->elasticity * glm::length(glm::cross(segment, tropism_->force));
        if (!std::isfinite(angle)) throw_at(position_, "tropism turns it by an angle that is not finite");
        orientation = glm::normalize(glm::angleAxis(angle, axis / size) * orientation);
    }

    void level() {
        glm::dquat& orientation = state_.place.orientation;
        const glm::dvec3 heading = orientation * ahead;
        const glm::dvec3 across = glm::cross(vertical, heading);
        const double size = glm::length(across);
        // If the heading is vertical, any left is level.
        if (size < 1e-9) return;
        const glm::dvec3 left = across / size;
        orientation = glm::normalize(glm::quat_cast(glm::dmat3(heading, left, glm::cross(heading, left))));
    }

    SpaceSink* sink_;
    double sway_;
    std::optional<Tropism> tropism_;
    std::vector<std::shared_ptr<const Surface>> surfaces_;
    std::vector<LabelText> labels_;
    double letter_height_;
    std::vector<Instruction> commands_;
    State state_;
    BracketStack<State> stack_;
    PolygonStack<Place, Vertex> polygons_;
    InsertedEdges<Place> edges_;
    std::uint64_t position_ = 0;
    bool is_framed_ = false;  ///< polygons are those of a framework
    bool joined_ = false;     ///< the last segment ended here
    SpaceSurvey survey_;
};

}  // namespace

std::unique_ptr<SpaceTurtle> SpaceTurtle::make(const Grammar& grammar, SpaceSink* sink, double sway) {
    return std::make_unique<WalkingSpaceTurtle>(grammar, sink, sway);
}

}  // namespace sikku
