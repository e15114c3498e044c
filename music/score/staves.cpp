#include "music/score/staves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace sikku {
namespace {

constexpr std::size_t most_own_staves = 12;
constexpr std::size_t voices_per_staff = 4;
constexpr std::size_t most_shared_staves = 12;  // with two voices each
constexpr int church_organ = 19;

// ---- instruments

/// A clef with its cost for each note, so that the usual one is preferred.
struct Candidate {
    Clef clef;
    double cost;
};

/// Instruments that are written an octave lower than they sound.
bool is_octave_higher(int program) {
    constexpr int celesta = 8;
    constexpr int glockenspiel = 9;
    constexpr int xylophone = 13;
    constexpr int piccolo = 72;
    constexpr int whistle = 78;
    return program == celesta || program == glockenspiel || program == xylophone || program == piccolo ||
           program == whistle;
}

/// @param is_high  most notes are above the treble clef
std::vector<Candidate> clefs_of(int program, bool is_high) {
    constexpr double unusual = 0.5;
    const auto is_within = [program](int first, int last) { return program >= first && program <= last; };
    if (is_within(24, 31)) return {{Clef::treble_8, 0}};
    if (is_within(32, 39) || program == 43) return {{Clef::bass_8, 0}, {Clef::treble_8, unusual}};
    if (is_octave_higher(program) && is_high) return {{Clef::treble_up_8, 0}};
    if (program == 41) return {{Clef::alto, 0}, {Clef::treble, 0.1}, {Clef::bass, unusual}};
    if (program == 42 || program == 57 || program == 70) {
        return {{Clef::bass, 0}, {Clef::tenor, 0.2}, {Clef::treble, unusual}};
    }
    if (program == 47 || program == 58) return {{Clef::bass, 0}, {Clef::treble, unusual}};
    const bool is_treble = program == 10 || program == 40 || program == 56 || program == 59 || is_within(64, 66) ||
                           is_within(68, 69) || is_within(71, 79) || program == 110;
    // Mallets are read in treble clef, too.
    const bool is_only_treble = is_treble || program == 9 || program == 11 || program == 13;
    return {{Clef::treble, 0}, {Clef::bass, is_only_treble ? 3.0 : 0.0}};
}

/// Cost of the ledger lines of a note: small up to two, large from four on.
double ledger_cost(int height, Clef clef, int octaves) {
    const int away = std::abs(height - 7 * octaves - middle_line(clef));
    static constexpr std::array<double, 4> few = {0, 0.15, 0.5, 1.5};
    const int lines = std::max(0, (away - 4) / 2);
    return lines < 4 ? few[static_cast<std::size_t>(lines)] : 1.5 + 2.5 * (lines - 3);
}

// ---- the cheapest sequence of states

/// Finds the cheapest sequence of `states` for `steps`. @param cost  cost of a step in a state
/// @param change  cost of a change of state before a step
template <typename Cost, typename Change>
std::vector<std::size_t> cheapest(std::size_t steps, std::size_t states, Cost cost, Change change) {
    std::vector<double> total(states, 0);
    std::vector<std::uint8_t> from(steps * states, 0);
    for (std::size_t i = 0; i < steps; ++i) {
        std::vector<double> next(states, std::numeric_limits<double>::infinity());
        for (std::size_t to = 0; to < states; ++to) {
            for (std::size_t before = 0; before < states; ++before) {
                const double sum =
                    total[before] + (i == 0 || before == to ? 0.0 : change(before, to, i)) + cost(to, i);
                if (i == 0 && before != to) continue;
                if (sum < next[to] - 1e-9) {
                    next[to] = sum;
                    from[i * states + to] = static_cast<std::uint8_t>(before);
                }
            }
        }
        total = std::move(next);
    }
    std::vector<std::size_t> result(steps);
    auto state = static_cast<std::size_t>(std::min_element(total.begin(), total.end()) - total.begin());
    for (std::size_t i = steps; i-- > 0;) {
        result[i] = state;
        state = from[i * states + state];
    }
    return result;
}

/// Index of the cost of a change: 0 after a rest, 1 at a bar line, 2 on a beat, 3 elsewhere.
std::size_t place_of(std::int64_t onset, bool is_after_rest, const BarLines& bars) {
    if (is_after_rest) return 0;
    if (bars.place(onset) == 0) return 1;
    return bars.place(onset) % ticks_per_quarter == 0 ? 2 : 3;
}

// ---- hands

int height_of(const Part& part, const Note& note) {
    return spelled(note.key, part.spelling).height();
}

double median_key(const std::vector<Note>& notes) {
    std::vector<double> keys;
    keys.reserve(notes.size());
    for (const Note& note : notes) keys.push_back(note.key);
    const auto middle = keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 2);
    std::nth_element(keys.begin(), middle, keys.end());
    return *middle;
}

/// Sorts voices from the highest to the lowest.
void sort_by_height(std::vector<StaffVoice>& voices) {
    std::stable_sort(voices.begin(), voices.end(), [](const StaffVoice& a, const StaffVoice& b) {
        return median_key(a.notes) > median_key(b.notes);
    });
}

/// Writes a voice on two staves: phrases change hands.
PartPlan split_by_hand(const Part& part, const std::vector<Note>& notes, int voice, const BarLines& bars) {
    constexpr std::array<double, 4> change_cost = {4, 6, 9, 16};
    const auto cost = [&](std::size_t hand, std::size_t i) {
        const int height = height_of(part, notes[i]);
        const Clef clef = hand == 0 ? Clef::treble : Clef::bass;
        const int side = hand == 0 ? 1 : -1;
        return std::min(ledger_cost(height, clef, 0), ledger_cost(height, clef, side) + 0.4);
    };
    const auto change = [&](std::size_t, std::size_t, std::size_t i) {
        const bool is_after_rest = notes[i - 1].onset + notes[i - 1].duration < notes[i].onset;
        return change_cost[place_of(notes[i].onset, is_after_rest, bars)];
    };
    const std::vector<std::size_t> hands = cheapest(notes.size(), 2, cost, change);
    PartPlan plan;
    plan.bracket = Bracket::brace;
    plan.staves.resize(2);
    for (StaffPlan& staff : plan.staves) staff.voices.push_back({voice, {}});
    plan.staves[0].clef = Clef::treble;
    plan.staves[1].clef = Clef::bass;
    for (std::size_t i = 0; i < notes.size(); ++i) plan.staves[hands[i]].voices.front().notes.push_back(notes[i]);
    return plan;
}

/// True if a single clef suffices for a melody for a keyboard.
bool fits_one_staff(const Part& part, const std::vector<Note>& notes) {
    for (const Clef clef : {Clef::treble, Clef::bass}) {
        double high = 0;
        std::size_t far = 0;
        for (const Note& note : notes) {
            const int height = height_of(part, note);
            const int side = height > middle_line(clef) ? 1 : -1;
            // 8va is for above a treble clef and for below a bass clef.
            const bool may_shift = (clef == Clef::treble) == (side > 0);
            const double cost =
                std::min(ledger_cost(height, clef, 0), may_shift ? ledger_cost(height, clef, side) + 0.3 : 1e9);
            high = std::max(high, cost);
            if (cost > 1) ++far;
        }
        if (high <= 4 && far * 20 <= notes.size()) return true;
    }
    return false;
}

/// Divides the voices of a keyboard between the hands, high ones to the right.
PartPlan divide_hands(std::vector<StaffVoice> voices) {
    sort_by_height(voices);
    std::size_t upper = voices.size() / 2;
    if (voices.size() == 3) {
        const double gap = median_key(voices[0].notes) - median_key(voices[1].notes);
        if (gap < median_key(voices[1].notes) - median_key(voices[2].notes)) upper = 2;
    }
    PartPlan plan;
    plan.bracket = Bracket::brace;
    plan.staves.resize(2);
    for (std::size_t i = 0; i < voices.size(); ++i) {
        plan.staves[i < upper ? 0 : 1].voices.push_back(std::move(voices[i]));
    }
    return plan;
}

/// True if all notes are within the compass of the pedal of a pipe organ.
bool fits_pedal(const std::vector<Note>& notes) {
    constexpr double lowest = 36, highest = 65;
    return std::all_of(notes.begin(), notes.end(),
                       [](const Note& note) { return note.key >= lowest && note.key <= highest; });
}

/// Divides three or four voices of an organ between hands and pedal, if the lowest can be played by it.
PartPlan divide_organ(std::vector<StaffVoice> voices) {
    sort_by_height(voices);
    if (!fits_pedal(voices.back().notes)) return divide_hands(std::move(voices));
    StaffPlan pedal{{std::move(voices.back())}, Clef::bass};
    voices.pop_back();
    PartPlan plan = divide_hands(std::move(voices));
    plan.staves.push_back(std::move(pedal));
    plan.has_pedal = true;
    return plan;
}

/// Merges notes that several voices share, and distributes the rest among few voices.
PartPlan share_staves(const std::vector<StaffVoice>& voices) {
    PartPlan plan;
    std::vector<std::pair<Note, int>> all;
    for (const StaffVoice& voice : voices) {
        for (const Note& note : voice.notes) all.emplace_back(note, voice.voice);
    }
    const auto place = [](const std::pair<Note, int>& note) {
        return std::tuple(note.first.onset, -note.first.key, -note.first.duration, note.second);
    };
    std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    std::vector<StaffVoice> shared;
    std::map<double, std::int64_t> sounds_until;
    for (auto& [note, voice] : all) {
        std::int64_t& until = sounds_until[note.key];
        if (note.onset + note.duration <= until) {
            ++plan.merged;
            continue;
        }
        until = note.onset + note.duration;
        // Chooses the line whose last note is nearest.
        StaffVoice* free = nullptr;
        for (StaffVoice& line : shared) {
            const Note& last = line.notes.back();
            if (last.onset + last.duration > note.onset) continue;
            if (!free || std::fabs(last.key - note.key) < std::fabs(free->notes.back().key - note.key)) free = &line;
        }
        if (!free) free = &shared.emplace_back(StaffVoice{voice, {}});
        free->notes.push_back(note);
    }
    sort_by_height(shared);
    const std::size_t staves = shared.size() <= most_own_staves ? shared.size() : (shared.size() + 1) / 2;
    if (staves > most_shared_staves) {
        throw ScoreError(
            fmt::format("{} notes sound at once, which needs too many staves for a page; a smaller n has "
                        "fewer",
                        shared.size()));
    }
    plan.staves.resize(staves);
    for (std::size_t i = 0; i < shared.size(); ++i) {
        plan.staves[i * staves / shared.size()].voices.push_back(std::move(shared[i]));
    }
    plan.bracket = staves > 1 ? Bracket::bracket : Bracket::none;
    return plan;
}

}  // namespace

bool is_keyboard(int program) {
    return program <= 8 || (program >= 16 && program <= 21) || program == 23 || program == 46;
}

PartPlan plan_staves(const Part& part, std::span<const std::vector<Note>> voices, int first_voice,
                     const BarLines& bars) {
    std::vector<StaffVoice> sounding;
    for (std::size_t i = 0; i < voices.size(); ++i) {
        if (!voices[i].empty()) sounding.push_back({first_voice + static_cast<int>(i), voices[i]});
    }
    if (sounding.empty()) return {};
    const bool has_hands = is_keyboard(part.program) && sounding.size() > 1;
    if (part.is_accompaniment && !has_hands && sounding.size() <= voices_per_staff) {
        sort_by_height(sounding);
        PartPlan plan;
        plan.staves.push_back({std::move(sounding), std::nullopt});
        return plan;
    }
    if (sounding.size() > most_own_staves) return share_staves(sounding);
    if (is_keyboard(part.program) && sounding.size() <= voices_per_staff) {
        if (sounding.size() > 2 && part.program == church_organ) return divide_organ(std::move(sounding));
        if (sounding.size() > 1) return divide_hands(std::move(sounding));
        if (!fits_one_staff(part, sounding.front().notes)) {
            PartPlan hands = split_by_hand(part, sounding.front().notes, sounding.front().voice, bars);
            if (std::none_of(hands.staves.begin(), hands.staves.end(),
                             [](const StaffPlan& staff) { return staff.voices.front().notes.empty(); })) {
                return hands;
            }
        }
    }
    if (sounding.size() <= voices_per_staff) sort_by_height(sounding);
    PartPlan plan;
    plan.bracket = sounding.size() > 1 ? Bracket::bracket : Bracket::none;
    for (StaffVoice& voice : sounding) {
        plan.staves.emplace_back().voices.push_back(std::move(voice));
    }
    return plan;
}

namespace {

/// A time on a staff at which symbols begin.
struct Moment {
    std::int64_t onset = 0;
    bool may_change = false;
    bool is_after_rest = false;
    std::vector<int> heights;  ///< heights of notes from here to the next moment
};

std::vector<Moment> moments_of(std::span<const NotatedVoice> voices) {
    std::map<std::int64_t, std::size_t> begins;  // number of voices that begin a symbol that is not tied
    std::map<std::int64_t, std::vector<int>> heights;
    std::map<std::int64_t, bool> rests;
    for (const NotatedVoice& voice : voices) {
        bool was_rest = true;
        for (const NotatedSymbol& symbol : voice.symbols) {
            if (!symbol.tied_back) ++begins[symbol.onset];
            if (symbol.kind == SymbolKind::note) {
                heights[symbol.onset].push_back(symbol.pitch.height());
                for (const ChordNote& note : symbol.chord) heights[symbol.onset].push_back(note.pitch.height());
                rests.try_emplace(symbol.onset, true).first->second &= was_rest;
            }
            was_rest = symbol.kind != SymbolKind::note;
        }
    }
    std::vector<Moment> moments;
    for (auto& [onset, list] : heights) {
        const auto found = begins.find(onset);
        moments.push_back(
            {onset, found != begins.end() && found->second == voices.size(), rests[onset], std::move(list)});
    }
    return moments;
}

struct State {
    Clef clef;
    int octaves;
    double cost;
};

/// True if most notes lie above the staff of a treble clef.
bool are_high(const std::vector<Moment>& moments) {
    std::size_t high = 0;
    std::size_t count = 0;
    for (const Moment& moment : moments) {
        count += moment.heights.size();
        high += static_cast<std::size_t>(std::count_if(moment.heights.begin(), moment.heights.end(), [](int height) {
            return height > middle_line(Clef::treble) + 4;
        }));
    }
    return 2 * high > count;
}

std::vector<State> states_of(const Part& part, std::optional<Clef> only, const std::vector<Moment>& moments) {
    // Costs of 8va, 15ma and 22ma for each note.
    constexpr std::array<double, 4> octave_cost = {0, 0.3, 1.5, 3};
    std::vector<State> states;
    const std::vector<Candidate> clefs =
        only ? std::vector<Candidate>{{*only, 0}} : clefs_of(part.program, are_high(moments));
    for (const auto& [clef, cost] : clefs) {
        const bool is_low = clef == Clef::bass || clef == Clef::bass_8;
        const bool is_high = clef == Clef::treble || clef == Clef::treble_8 || clef == Clef::treble_up_8;
        states.push_back({clef, 0, cost});
        for (int octaves = 1; octaves <= 3; ++octaves) {
            const double sum = cost + octave_cost[static_cast<std::size_t>(octaves)];
            if (is_high) states.push_back({clef, octaves, sum});
            if (is_low) states.push_back({clef, -octaves, sum});
        }
        if (clef == Clef::treble_8) states.push_back({clef, -1, cost + 0.4});
    }
    return states;
}

}  // namespace

std::vector<StaffChange> choose_clefs(const Part& part, std::optional<Clef> only,
                                      std::span<const NotatedVoice> voices, const BarLines& bars) {
    constexpr std::array<double, 4> clef_change = {6, 7, 11, 20};
    constexpr std::array<double, 4> octave_change = {4, 5, 6, 8};
    const std::vector<Moment> moments = moments_of(voices);
    const std::vector<State> states = states_of(part, only, moments);
    if (moments.empty()) return {{0, states.front().clef, 0}};
    const auto cost = [&](std::size_t state, std::size_t i) {
        double sum = 0;
        for (const int height : moments[i].heights) {
            const State& chosen = states[state];
            sum += ledger_cost(height, chosen.clef, chosen.octaves) + chosen.cost;
            // Penalty for 8va over notes that would be on the staff without it.
            if (chosen.octaves != 0 && ledger_cost(height, chosen.clef, 0) < 1) sum += 0.8;
        }
        return sum;
    };
    const auto change = [&](std::size_t before, std::size_t to, std::size_t i) {
        if (!moments[i].may_change) return std::numeric_limits<double>::infinity();
        const std::size_t place = place_of(moments[i].onset, moments[i].is_after_rest, bars);
        return (states[before].clef != states[to].clef ? clef_change[place] : 0.0) +
               (states[before].octaves != states[to].octaves ? octave_change[place] : 0.0);
    };
    const std::vector<std::size_t> path = cheapest(moments.size(), states.size(), cost, change);
    std::vector<StaffChange> changes;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const State& state = states[path[i]];
        if (i > 0 && path[i] == path[i - 1]) continue;
        // A line of 8va begins with its first note, the clef with the score.
        if (i == 0 && moments[0].onset > 0) {
            changes.push_back({0, state.clef, 0});
            if (state.octaves == 0) continue;
        }
        changes.push_back({moments[i].onset, state.clef, state.octaves});
    }
    return changes;
}

}  // namespace sikku
