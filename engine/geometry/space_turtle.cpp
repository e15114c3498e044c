#include "engine/geometry/space_turtle.h"

#include "engine/geometry/lattice.h"
#include "engine/geometry/turtle_state.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

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
    switch (action) {
        case Action::pitch:
            return rotation(degrees, leftwards);
        case Action::roll:
            return rotation(-degrees, ahead);
        default:
            return rotation(degrees, upwards);
    }
}

void widen(SpaceBounds& bounds, const glm::dvec3& point) {
    bounds.low = glm::min(bounds.low, point);
    bounds.high = glm::max(bounds.high, point);
}

class WalkingSpaceTurtle final : public SpaceTurtle {
public:
    WalkingSpaceTurtle(const Grammar& grammar, SpaceSink* sink) : sink_(sink), tropism_(grammar.tropism()) {
        for (const SymbolInfo& symbol : grammar.symbols()) {
            const Command& command = symbol.command;
            Instruction instruction{command.action, command.value, command.takes_argument, symbol.arity, {}};
            if (!std::isfinite(command.angle.degrees)) instruction.value = command.angle.degrees;
            if (turns(command.action) && !command.takes_argument) {
                instruction.turn = rotation(command.action, command.angle.degrees);
            }
            commands_.push_back(instruction);
        }
        state_.place.orientation = rotation(grammar.heading().degrees, upwards);
    }

    void symbols(const Run& run) override {
        const double* next = run.arguments.data();
        for (const Symbol symbol : run.symbols) {
            const Instruction& command = commands_[symbol];
            ++position_;
            if (command.action != Action::pass) {
                obey(command, command.takes_argument ? command.value * *next : command.value);
            }
            next += command.arity;
        }
    }

    void finish() override {
        stack_.finish();
        polygons_.finish();
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
    struct State {
        Place place;
        Pen pen;
        Pen before;  ///< the pen of the last segment on the way here
        bool came = false;
    };
    struct Instruction {
        Action action;
        double value;
        bool takes_argument;
        std::uint32_t arity;
        glm::dquat turn;
    };

    static bool turns(Action action) {
        return action == Action::turn || action == Action::pitch || action == Action::roll;
    }

    void obey(const Instruction& command, double value) {
        if (!std::isfinite(value)) throw_at(position_, "its parameter is not finite");
        switch (command.action) {
            case Action::draw:
                draw(value);
                break;
            case Action::move:
                step(value);
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
                stack_.push(state_, position_);
                survey_.depth = std::max(survey_.depth, stack_.depth());
                joined_ = false;
                break;
            case Action::pop:
                state_ = stack_.pop(position_);
                joined_ = false;
                break;
            case Action::polygon_begin:
                polygons_.begin(state_.place, position_);
                break;
            case Action::polygon_end: {
                const std::vector<glm::dvec3> vertices = polygons_.end(position_);
                if (sink_ && vertices.size() >= 3) sink_->polygon(vertices, state_.pen);
                break;
            }
            case Action::disc:
                if (sink_) sink_->sphere(state_.place.at, std::fabs(value), state_.pen);
                break;
            default:
                change_pen(state_.pen, command.action, value);
        }
    }

    void draw(double length) {
        const glm::dvec3 from = state_.place.at;
        note_ink(from);
        step(length);
        widen(*survey_.ink, state_.place.at);
        ++survey_.drawn;
        survey_.length += std::fabs(length);
        if (sink_)
            sink_->segment(from, state_.came ? state_.before : state_.pen, state_.place.at, state_.pen, joined_);
        state_.before = state_.pen;
        state_.came = joined_ = true;
        if (tropism_) bend(state_.place.at - from);
    }

    void step(double length) {
        Place& place = state_.place;
        place.at += length * (place.orientation * ahead);
        if (!(glm::length(place.at) <= 1e300)) {
            throw_at(position_, "the turtle leaves the range of its coordinates");
        }
        ++survey_.moves;
        widen(survey_.box, place.at);
        if (!polygons_.empty()) {
            polygons_.add(place, [](const Place& there) { return there.at; });
        }
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
        // Upright, any left is level.
        if (size < 1e-9) return;
        const glm::dvec3 left = across / size;
        orientation = glm::normalize(glm::quat_cast(glm::dmat3(heading, left, glm::cross(heading, left))));
    }

    SpaceSink* sink_;
    std::optional<Tropism> tropism_;
    std::vector<Instruction> commands_;
    State state_;
    BracketStack<State> stack_;
    PolygonStack<Place, glm::dvec3> polygons_;
    std::uint64_t position_ = 0;
    bool joined_ = false;  ///< the last segment ended here
    SpaceSurvey survey_;
};

}  // namespace

std::unique_ptr<SpaceTurtle> SpaceTurtle::make(const Grammar& grammar, SpaceSink* sink) {
    return std::make_unique<WalkingSpaceTurtle>(grammar, sink);
}

}  // namespace sikku
