// music/melody/shaper.h: shapes the notes of a melody between the curve and the scale: cadences, articulation, swing.
#pragma once

#include "music/melody/degree_range.h"
#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku::mapping {

/// Holds back the last notes of each voice until it is known whether they end a phrase. The result for a note
/// depends only on its time and on the notes around it, so that a piece from the middle sounds as in the melody.
class Shaper {
public:
    /// Key of a note that is stated by degree: not a number.
    static constexpr double by_degree = std::numeric_limits<double>::quiet_NaN();
    struct Draft {
        std::int64_t degree = 0;
        std::int64_t onset = 0;
        std::int64_t end = 0;
        int velocity = 80;
        int depth = 0;  ///< brackets around it
        int level = 0;  ///< as in Note
        glm::dvec2 from{0.0};
        glm::dvec2 to{0.0};
        std::uint64_t symbol = 0;
        int voice = 0;
        bool is_first = false;   ///< first note of its phrase
        bool is_last = false;    ///< last note of its phrase
        bool is_moved = false;   ///< its degree was brought into the range
        double key = by_degree;  ///< fixed key, which cadences and chords do not change; else by_degree
        bool is_drum = false;
        bool is_silent = false;  ///< a rest by chance
        std::int64_t glide = 0;  ///< ticks at its end in which its pitch slides to the next note
        std::int64_t goal = 0;   ///< degree that it slides to if no note begins at its end
        float rise = 0;          ///< as in Glide
        ChordSign chord{};       ///< chord that it belongs to
        Emphasis emphasis{};     ///< velocities do not include accents yet
        bool is_fixed() const { return key == key; }
    };

    explicit Shaper(const Melody& melody);
    /// Sets the voice that triads follow, counted from 0.
    void follow(int voice) { leader_ = voice; }
    void add(int voice, Draft note);
    void end_phrase(int voice, bool is_odd);
    /// Ends the notes. @param is_end  the melody ends here, and with it a phrase
    void finish(bool is_end);
    /// Onset of the first note that is held back; INT64_MAX if there is none.
    std::int64_t first_pending() const;
    /// A chord of complete bars.
    struct BarChord {
        std::int64_t begin = 0;  ///< tick of the first bar
        std::int64_t end = 0;    ///< tick after the last
        const Chord* chord = nullptr;
    };
    std::vector<BarChord> take_chords() { return std::exchange(chords_, {}); }
    /// The given chord of the bar that contains `tick`; null if chords are not given.
    const Chord* given_chord(std::int64_t tick) const;
    /// The notes that are ready, by voice in order. Valid until the next call.
    std::span<const Draft> take();

private:
    void keep_within(Draft& note) const;
    std::int64_t tone_of(const Chord& chord, std::int64_t degree) const;
    void cadence(std::vector<Draft>& notes, bool is_odd) const;
    void release(Draft note);
    void harmonise(Draft note);
    void name(Draft& note, const Chord& chord) const;
    void close_bar();
    void go_on_until(std::int64_t tick);
    void perform(Draft note);
    bool is_strong(const Draft& note) const;
    void swing(Draft& note);
    std::int64_t swung(std::int64_t tick) const;

    const Melody& melody_;
    std::optional<DegreeRange> range_;         // set if it changes degrees by other than whole periods
    std::size_t held_;                         // notes of a voice that are held back
    std::int64_t fifth_;                       // degrees from the tonic to the fifth
    std::vector<std::int64_t> strong_beats_;   // ticks of a bar
    std::vector<std::vector<Draft>> pending_;  // by voice
    std::vector<Chord> triads_;
    int leader_ = 0;
    std::vector<Draft> bar_;  // bar of the voice that chords follow, until its chord is known
    std::vector<BarChord> chords_;
    BarChord latest_;                        // the last one chosen
    std::int64_t sounding_until_ = 0;        // end of the last note of its bar
    std::int64_t last_bar_ = -1;             // tick of the last bar, once the melody has ended
    std::vector<std::int64_t> swung_until_;  // by voice: end of the last note, if notes swing
    std::vector<Draft> ready_;
    std::vector<Draft> taken_;
};

}  // namespace sikku::mapping
