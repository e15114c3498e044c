// music/melody/expression.h: how velocity, tempo, pan, a controller and the pitch within notes follow the curve: the
// keys velocity, tempo, pan, controller and gamaka.
#pragma once

#include "engine/language/pattern.h"

#include <cstdint>
#include <vector>

namespace sikku {

struct Melody;

/// Quantity that a curve of expression follows, from its least value in the piece to its greatest.
enum class ExpressionSource {
    none,
    x,       ///< place along the x axis
    y,       ///< place along the y axis
    depth,   ///< brackets around a note
    turn,    ///< turn to the right, straight ahead, or to the left, before a note
    length,  ///< duration of a note
    level    ///< order of the largest sub-curve that begins with a note
};

/// The least and the greatest value of a source in the notes of a part.
struct SourceRange {
    double low = 0;
    double high = 0;
    /// The position of a value in the range, from 0 to 1.
    double part(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

struct ExpressionCurve {
    ExpressionSource source = ExpressionSource::none;
    double low = 0;   ///< at the least value of the source
    double high = 0;  ///< at the greatest; may be below `low`
    bool is_on() const { return source != ExpressionSource::none; }
    double at(double part) const { return low + (high - low) * part; }
};

/// An ornament of some degrees of the scale.
struct Gamaka {
    enum class Kind {
        kampita,  ///< swings between the note and the degree above, at most a whole tone, five times a second
        jaru,     ///< slides from the note before
        meend     ///< slides to the note after
    };
    enum class Approach {
        any,
        rising,  ///< only after a lower note
        falling  ///< only after a higher note
    };
    Kind kind = Kind::kampita;
    std::vector<std::int64_t> degrees;  ///< within a period, 0 is the tonic; empty: all
    Approach approach = Approach::any;
};

struct MelodicExpression {
    ExpressionCurve velocity;
    ExpressionCurve tempo;  ///< quarters a minute
    ExpressionCurve pan;    ///< 0 left, 64 middle, 127 right
    ExpressionCurve control;
    int controller = 0;  ///< number of the MIDI controller for `control`
    std::vector<Gamaka> gamakas;

    bool any() const {
        return velocity.is_on() || tempo.is_on() || pan.is_on() || control.is_on() || !gamakas.empty();
    }
    bool uses(ExpressionSource source) const {
        return velocity.source == source || tempo.source == source || pan.source == source ||
               control.source == source;
    }
};

/// True for a value such as `96 by y 80-112` or `by level`.
bool states_curve(std::string_view value);

/// Reads the keys into `melody.expression`. Errors go to `diagnostics`.
void read_expression(const Pattern& pattern, Melody& melody, Diagnostics& diagnostics);

}  // namespace sikku
