#include "music/form/block.h"

#include "engine/base/text.h"
#include "music/melody/accompaniment.h"
#include "music/melody/degree_range.h"
#include "music/score/glides.h"
#include "music/score/rhythm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t notes_of_ending = 3;

class BlockSink : public NoteSink {
public:
    BlockSink(Block& block, const std::vector<std::int64_t>& degrees) : block_(block), degrees_(degrees) {}
    void notes(std::span<const Note> notes) override {
        if (notes.size() > most_block_notes - block_.notes.size()) {
            throw ScoreError(
                fmt::format("parts in forms, with a climax, reversed, repeated or strict have at most {} notes; "
                            "`excerpt` or a smaller n has fewer",
                            most_block_notes));
        }
        for (const Note& note : notes) {
            const std::int64_t degree = degrees_[block_.notes.size()];
            const bool has_degree = degree != PlayOptions::no_degree;
            block_.notes.push_back({note, has_degree ? degree : 0, has_degree});
        }
    }
    void finish(std::int64_t end) override { block_.length = end; }

private:
    Block& block_;
    const std::vector<std::int64_t>& degrees_;
};

void sort(std::vector<FormNote>& notes) {
    std::stable_sort(notes.begin(), notes.end(), [](const FormNote& a, const FormNote& b) {
        return std::tie(a.note.onset, a.note.voice) < std::tie(b.note.onset, b.note.voice);
    });
}

/// The notes of `block` from `begin` to `end`, moved to tick 0.
/// @param begin_of  of a note; its end is as much later
template <class BeginOf>
Block cut(const Block& block, std::int64_t begin, std::int64_t end, const BeginOf& begin_of) {
    Block piece;
    piece.length = end - begin;
    piece.chords_from = block.chords_from;
    for (FormNote one : block.notes) {
        const std::int64_t from = begin_of(one);
        const std::int64_t to = from + piece.length;
        if (std::max(one.note.onset, from) >= std::min(one.note.onset + one.note.duration, to)) continue;
        sikku::cut(one.note, from, to);
        one.note.onset -= begin;
        piece.notes.push_back(one);
    }
    return piece;
}

Block cut(const Block& block, std::int64_t begin, std::int64_t end) {
    return cut(block, begin, end, [begin](const FormNote&) { return begin; });
}

/// Sets the length of a section: its last notes are held or cut off.
void fit(Block& piece, std::int64_t length) {
    for (FormNote& one : piece.notes) {
        const bool is_last = one.note.onset + one.note.duration == piece.length;
        if (is_last && piece.length < length) one.note.duration += length - piece.length;
    }
    piece = cut(piece, 0, length);
}

/// The notes of each voice, by onset.
std::map<int, std::vector<FormNote*>> voices_of(std::vector<FormNote>& notes) {
    std::map<int, std::vector<FormNote*>> voices;
    for (FormNote& one : notes) voices[one.note.voice].push_back(&one);
    for (auto& [voice, line] : voices) {
        std::stable_sort(line.begin(), line.end(),
                         [](const FormNote* a, const FormNote* b) { return a->note.onset < b->note.onset; });
    }
    return voices;
}

bool has_glides(const std::vector<FormNote>& notes) {
    return std::any_of(notes.begin(), notes.end(), [](const FormNote& one) { return one.note.glide.ticks > 0; });
}

/// Reverses slides: the slide to a note moves to the beginning of that note, which is its end once time is reversed.
/// A slide that does not lead to a note becomes a note.
void turn_glides(std::vector<FormNote>& notes) {
    if (!has_glides(notes)) return;
    std::vector<FormNote> added;
    for (const auto& [voice, line] : voices_of(notes)) {
        Glide carried;  // slide from the note before to this one
        for (std::size_t i = 0; i < line.size(); ++i) {
            Note& note = line[i]->note;
            const Glide glide = note.glide;
            note.glide = carried;
            note.is_sliding = carried.semitones != 0;
            carried = {};
            if (glide.ticks == 0) continue;
            const std::int64_t end = note.onset + note.duration;
            const Glide back{glide.ticks, -glide.semitones, -glide.rise};
            Note* const next = i + 1 < line.size() ? &line[i + 1]->note : nullptr;
            note.duration -= glide.ticks;
            if (next && next->onset == end) {
                next->onset -= glide.ticks;
                next->duration += glide.ticks;
                carried = back;
                continue;
            }
            FormNote alone = *line[i];
            alone.note.onset = end - glide.ticks;
            alone.note.duration = glide.ticks;
            alone.note.key += static_cast<double>(glide.semitones);
            alone.note.from = alone.note.to = {note.to.x, note.to.y + static_cast<double>(glide.rise)};
            alone.note.glide = back;
            alone.note.is_sliding = back.semitones != 0;
            alone.note.begins_phrase = false;
            alone.has_degree = false;
            added.push_back(alone);
        }
    }
    notes.insert(notes.end(), added.begin(), added.end());
    notes.erase(
        std::remove_if(notes.begin(), notes.end(), [](const FormNote& one) { return one.note.duration == 0; }),
        notes.end());
}

/// Marks the last note of each phrase as its beginning, for reversed notes.
void turn_phrases(std::vector<FormNote>& notes) {
    for (const auto& [voice, line] : voices_of(notes)) {
        bool is_last =
            std::any_of(line.begin(), line.end(), [](const FormNote* one) { return one->note.begins_phrase; });
        for (auto one = line.rbegin(); one != line.rend(); ++one) {
            is_last = std::exchange((*one)->note.begins_phrase, is_last);
        }
    }
}

/// @param block  to which the note belongs
bool is_chord(const FormNote& one, const Block& block, const Melody& melody) {
    const int voice = one.note.voice - block.chords_from;
    return melody.has_chords() && voice >= 0 && voice < melody.accompanying_voices();
}

bool is_same_class(double a, double b) {
    return std::fabs(std::remainder(a - b, 12)) < 0.01;
}

/// Trims the chords of a section to begin with it and to end before its last rest: the remainder of a chord before
/// the first bar line joins the next chord if it is shorter than a beat, and chords after the last note are removed.
/// @param first  the bar line after the upbeat of the section, before which no chord sounds; 0 without an upbeat
void trim_chords(Block& piece, const Melody& melody, std::int64_t first) {
    if (!melody.has_chords() || melody.accompanying_voices() == 0) return;
    std::int64_t last = 0;
    std::int64_t next = piece.length;  // onset of the second chord
    for (const FormNote& one : piece.notes) {
        if (!is_chord(one, piece, melody)) {
            last = std::max(last, one.note.onset + one.note.duration);
        } else if (one.note.onset > 0) {
            next = std::min(next, one.note.onset);
        }
    }
    std::erase_if(piece.notes,
                  [&](const FormNote& one) { return is_chord(one, piece, melody) && one.note.onset >= last; });
    if (first > 0) {
        for (FormNote& one : piece.notes) {
            if (!is_chord(one, piece, melody) || one.note.onset >= first) continue;
            one.note.duration -= first - one.note.onset;
            one.note.onset = first;
        }
        std::erase_if(piece.notes, [](const FormNote& one) { return one.note.duration <= 0; });
        sort(piece.notes);
        return;
    }
    // The rest is about chords that last a bar, not about strokes of a figure.
    if (!melody.figure.layers.empty()) return;
    if (next >= last || next >= melody.meter.bar() / melody.meter.beats) return;
    std::erase_if(piece.notes,
                  [&](const FormNote& one) { return is_chord(one, piece, melody) && one.note.onset < next; });
    for (FormNote& one : piece.notes) {
        if (!is_chord(one, piece, melody) || one.note.onset != next) continue;
        one.note.duration += next;
        one.note.onset = 0;
    }
    sort(piece.notes);
}

/// The notes of a section, moved to tick 0. Chords begin at the bar line after its upbeat, and last until the bar
/// line after that of the next section.
Block cut_section(const Block& block, std::int64_t begin, std::int64_t end, const Melody& melody) {
    const std::int64_t opening = melody.layout.opening();
    return cut(block, begin, end,
               [&](const FormNote& one) { return begin + (is_chord(one, block, melody) ? opening : 0); });
}

/// Changes the chord from the last note of an ending on to that of its goal.
void close_chords(Block& block, const Melody& melody, const Note& last, Ending ending) {
    if (!melody.has_chords() || melody.accompanying_voices() == 0) return;
    const bool is_open = ending == Ending::open;
    bool fits = false;
    std::int64_t end = 0;
    for (const FormNote& one : block.notes) {
        const Note& note = one.note;
        if (!is_chord(one, block, melody) || note.onset + note.duration <= last.onset) continue;
        end = std::max(end, note.onset + note.duration);
        // The root of a chord is its bass.
        const bool is_goal = note.onset <= last.onset && is_same_class(note.key, last.key);
        fits = fits || (is_goal && (is_open || note.voice == block.chords_from));
    }
    if (end == 0 || fits) return;
    for (FormNote& one : block.notes) {
        if (is_chord(one, block, melody))
            one.note.duration = std::min(one.note.duration, last.onset - one.note.onset);
    }
    std::erase_if(block.notes, [](const FormNote& one) { return one.note.duration <= 0; });
    const Chord chord = triad_on(melody.scale, is_open ? fifth_degree(melody.scale) : 0);
    const std::int64_t bar = melody.meter.bar();
    for (Note note :
         mapping::Accompaniment(melody).bar((last.onset + melody.begin()) / bar * bar, &chord, nullptr, true)) {
        note.onset = last.onset;
        note.duration = end - last.onset;
        note.voice = static_cast<std::int16_t>(note.voice + block.chords_from);
        block.notes.push_back({note, 0, false});
    }
    sort(block.notes);
}

/// The end of the last note that is not part of a chord; 0 if there is none.
std::int64_t end_of_melody(const Block& block, const Melody& melody) {
    std::int64_t end = 0;
    for (const FormNote& one : block.notes) {
        if (!is_chord(one, block, melody)) end = std::max(end, one.note.onset + one.note.duration);
    }
    return end;
}

/// The last note of the first voice that has a degree, or null.
const FormNote* last_with_degree(const Block& block) {
    const auto last = std::find_if(block.notes.rbegin(), block.notes.rend(),
                                   [](const FormNote& one) { return one.has_degree && one.note.voice == 0; });
    return last == block.notes.rend() ? nullptr : &*last;
}

/// The ticks at which sub-curves begin.
std::vector<std::int64_t> begins_of(const Block& block) {
    std::vector<std::int64_t> begins = {0};
    for (const std::int64_t end : block.ends) {
        if (end > begins.back() && end < block.length) begins.push_back(end);
    }
    return begins;
}

/// The phrases or sections of a block.
class Phrases {
public:
    explicit Phrases(const Block& block) : begins_(begins_of(block)) {}
    std::size_t count() const { return begins_.size(); }
    /// The phrase in which a tick lies.
    std::size_t at(std::int64_t tick) const {
        return static_cast<std::size_t>(std::upper_bound(begins_.begin(), begins_.end(), tick) - begins_.begin()) - 1;
    }
    /// The tick at which a phrase begins.
    std::int64_t begin(std::size_t phrase) const { return begins_[phrase]; }

private:
    std::vector<std::int64_t> begins_;
};

/// Reverses a section, whose breath stays at its end.
void reverse_section(Block& piece, const Melody& melody) {
    const std::int64_t length = piece.length;
    piece = cut(piece, 0, end_of_melody(piece, melody));
    reverse(piece);
    piece.length = length;
}

/// The key of a degree that a note is moved to, within the range. `degree` becomes the one that sounds.
/// @throws ScoreError for degrees without a key, or beyond a range that refuses them
double key_moved_to(const Melody& melody, const std::optional<mapping::DegreeRange>& range, std::int64_t& degree,
                    bool falling) {
    if (range) degree = range->inside(degree - melody.answer) + melody.answer;
    const auto raw = melody.key(degree - melody.answer, falling);
    if (!raw) throw ScoreError(fmt::format("a note is moved to degree {} of the scale, which has no key", degree));
    if (melody.range == Range::refuse && (*raw < melody.lowest || *raw > melody.highest)) {
        throw ScoreError(
            fmt::format("a note is moved to degree {} of the scale, beyond the keys {:.0f} to {:.0f}: "
                        "`range: fold` or a smaller interval helps",
                        degree, melody.lowest, melody.highest));
    }
    return key_within(melody, degree, falling);
}

std::optional<mapping::DegreeRange> bounds_of(const Melody& melody) {
    const bool is_bounded = melody.range == Range::reflect || melody.range == Range::clamp;
    return is_bounded ? std::optional<mapping::DegreeRange>(melody) : std::nullopt;
}

/// Moves notes to other degrees; those whose degree stays are left alone.
/// @param degree_of  gives the new degree of a note
template <class DegreeOf>
void move_notes(std::vector<FormNote>& notes, const Melody& melody, const DegreeOf& degree_of) {
    struct Line {
        std::int64_t last = 0;
        bool falling = false;
    };
    std::map<int, Line> lines;  // by voice
    const auto range = bounds_of(melody);
    for (FormNote& one : notes) {
        if (!one.has_degree) continue;
        std::int64_t degree = degree_of(one);
        auto [line, is_new] = lines.try_emplace(one.note.voice, Line{degree});
        if (degree != line->second.last) line->second.falling = degree < line->second.last;
        line->second.last = degree;
        if (degree == one.degree) continue;
        one.note.key = key_moved_to(melody, range, degree, line->second.falling);
        one.degree = degree;
    }
}

/// Plays a section three times, with equal pauses between them. Chooses the shortest pause, a multiple of the unit,
/// for which the third time ends at a bar line; if there is none, the one that needs the shortest rest before the
/// first time. Repeats chords, too.
void repeat_as_korvai(Block& piece, const Melody& melody) {
    constexpr int times = 3;
    const std::int64_t bar = melody.meter.bar();
    const std::int64_t sounding = end_of_melody(piece, melody);
    if (sounding == 0) return;
    std::int64_t pause = 0;
    std::int64_t rest = bar;
    for (std::int64_t tried = melody.unit; tried < std::max(bar, 2 * melody.unit) && rest > 0; tried += melody.unit) {
        const std::int64_t over = (times * sounding + (times - 1) * tried + melody.begin()) % bar;
        const std::int64_t needed = (bar - over) % bar;
        if (needed >= rest) continue;
        rest = needed;
        pause = tried;
    }
    const Block once = cut(piece, 0, sounding);
    piece.notes.clear();
    for (int i = 0; i < times; ++i) {
        for (FormNote one : once.notes) {
            one.note.onset += rest + i * (sounding + pause);
            piece.notes.push_back(one);
        }
    }
    piece.length = rest + times * sounding + (times - 1) * pause;
}

/// Ends a korvai with the tonic on the downbeat, held for a bar.
void land(Block& piece, const Melody& melody) {
    const FormNote* const last = last_with_degree(piece);
    if (!last) return;
    FormNote goal = *last;
    const auto period = static_cast<std::int64_t>(melody.scale.size());
    goal.degree = mapping::goal_near(last->degree, 0, period, bounds_of(melody), melody.answer);
    goal.note.key = key_within(melody, goal.degree, goal.degree < last->degree);
    goal.note.begins_phrase = false;
    goal.note.onset = piece.length;
    goal.note.duration = melody.meter.bar();
    goal.note.glide = {};
    goal.note.is_sliding = false;
    piece.notes.push_back(goal);
    piece.length += goal.note.duration;
}

/// Keeps the last two bars of a section, with their upbeat, and repeats the last one with notes twice as long.
void make_coda(Block& piece, const Melody& melody) {
    const std::int64_t bar = melody.meter.bar();
    const std::int64_t upbeat = melody.layout.opening();
    const std::int64_t end = (end_of_melody(piece, melody) - upbeat + bar - 1) / bar * bar + upbeat;
    const std::int64_t last = std::max<std::int64_t>(0, end - bar);
    Block again = cut(piece, last, end);
    scale_times(again, {2, 1});
    piece = cut(piece, std::max<std::int64_t>(0, end - 2 * bar - upbeat), end);
    for (FormNote& one : again.notes) {
        one.note.onset += piece.length;
        piece.notes.push_back(one);
    }
    piece = cut(piece, 0, end_of_melody(piece, melody));
}

/// The rest before an augmented or diminished section, whose upbeat ends at a bar line of the score after it.
std::int64_t rest_before(const Melody& melody, Ratio augmentation) {
    const std::int64_t bar = melody.meter.bar();
    const std::int64_t upbeat = melody.layout.opening();
    const std::int64_t late = (upbeat - augmentation.of(upbeat)) % bar;
    return late < 0 ? late + bar : late;
}

/// The bar line after the upbeat of a section, in ticks of the section; 0 without an upbeat.
std::int64_t first_bar_line(const Melody& melody, const FormSection& section) {
    const std::int64_t upbeat = melody.layout.opening();
    if (section.is_coda) return upbeat;
    return rest_before(melody, section.augmentation) + section.augmentation.of(upbeat);
}

/// Ends chords before a tick. @param first  index of the first note to look at
void end_chords(Block& block, const Melody& melody, std::size_t first, std::int64_t until) {
    for (std::size_t i = first; i < block.notes.size(); ++i) {
        Note& note = block.notes[i].note;
        if (is_chord(block.notes[i], block, melody)) note.duration = std::min(note.duration, until - note.onset);
    }
    const auto begin = block.notes.begin() + static_cast<std::ptrdiff_t>(first);
    block.notes.erase(
        std::remove_if(begin, block.notes.end(), [](const FormNote& one) { return one.note.duration <= 0; }),
        block.notes.end());
}

/// The tick at which the first chord begins; `otherwise` without chords.
std::int64_t first_chord(const Block& piece, const Melody& melody, std::int64_t otherwise) {
    std::int64_t first = INT64_MAX;
    for (const FormNote& one : piece.notes) {
        if (is_chord(one, piece, melody)) first = std::min(first, one.note.onset);
    }
    return first < INT64_MAX ? first : otherwise;
}

/// Applies the changes that a form states for a section.
void change_section(Block& piece, const Melody& melody, const FormSection& section) {
    if (section.is_retrograde) reverse_section(piece, melody);
    scale_times(piece, section.augmentation);
    const std::int64_t rest = rest_before(melody, section.augmentation);
    for (FormNote& one : piece.notes) one.note.onset += rest;
    piece.length += rest;
    if (section.is_coda) make_coda(piece, melody);
    if (section.is_korvai) repeat_as_korvai(piece, melody);
    if (!section.has_other_degrees()) return;
    const auto first =
        std::find_if(piece.notes.begin(), piece.notes.end(), [](const FormNote& one) { return one.has_degree; });
    if (first == piece.notes.end()) return;
    const std::int64_t axis = first->degree;
    move_notes(piece.notes, melody, [&](const FormNote& one) {
        return (section.is_inverted ? 2 * axis - one.degree : one.degree) + section.degrees;
    });
}

/// The ending of a section; the last of a form ends on the tonic if cadences alternate.
Ending ending_of(const Block& piece, const Melody& melody, const FormSection& section, bool is_last) {
    // A coda ends on the tonic.
    if (section.is_coda && section.ending == Ending::none) return Ending::closed;
    if (!is_last || section.ending != Ending::none || melody.cadence != Cadence::alternate) return section.ending;
    const FormNote* const last = last_with_degree(piece);
    if (!last) return Ending::none;
    const bool is_tonic = (last->degree - melody.answer) % static_cast<std::int64_t>(melody.scale.size()) == 0;
    return is_tonic ? Ending::none : Ending::closed;
}

/// Reports a section that the curve lacks.
[[noreturn]] void refuse_section(const Grammar& grammar, const Melody& melody, const std::vector<FormSection>& form,
                                 const FormSection& missing, std::size_t sub_curves) {
    int last = 0;
    for (const FormSection& section : form) last = std::max(last, static_cast<int>(section.letter));
    const auto steps = smallest_steps(grammar, melody, last + 1);
    // Without an order, sections are the largest sub-curves.
    const std::int64_t largest = std::max<std::int64_t>(1, grammar.steps() - 1);
    const std::int64_t order = melody.phrase_order > 0 ? melody.phrase_order : largest;
    const std::int64_t lower = std::min(order - 1, largest);
    std::string remedy = steps ? fmt::format("n = {} has enough", *steps) : "";
    if (lower > 0) {
        remedy += fmt::format("{}a lower order has more: {}", steps ? ", and " : "",
                              melody.layout.is_order_of_phrases ? fmt::format("`phrases: {}`", lower)
                                                                : fmt::format("`form: A B order {}`", lower));
    }
    throw ScoreError(fmt::format("section {} of the form is missing: the curve has {} of order {}{}{}{}",
                                 static_cast<char>('A' + missing.letter), counted(sub_curves, "sub-curve"), order,
                                 melody.layout.is_order_of_phrases ? ", that of 'phrases:'" : "",
                                 remedy.empty() ? "" : "; ", remedy));
}

}  // namespace

std::int64_t end_of_sections(const Block& block, const Melody& melody) {
    return melody.layout.opening() > 0 ? block.melody_end : block.length;
}

Block play_block(PlayableMelody& playable, const Melody& melody, const PlayOptions& options, PlayReport& report) {
    Block block;
    std::vector<std::int64_t> degrees;
    PlayOptions recording = options;
    recording.degrees = &degrees;
    recording.phrase_ends = &block.ends;
    BlockSink sink(block, degrees);
    report = playable.play(melody, sink, recording);
    block.melody_end = report.melody_end;
    sort(block.notes);
    block.chords_from = options.chords_from > 0 ? options.chords_from : melody.own_voices();
    const bool is_whole = block.length < options.to - options.from;
    // The notes after the last sub-curve end with a breath, too.
    const std::int64_t bar = melody.breathes_to_bar ? melody.meter.bar() : 1;
    const std::int64_t breath = is_whole && melody.phrase_order > 0 ? melody.breath : 0;
    block.next = (end_of_sections(block, melody) + breath + bar - 1) / bar * bar;
    while (!block.ends.empty() && block.ends.back() >= block.length) {
        if (is_whole) block.next = block.ends.back();
        block.ends.pop_back();
    }
    return block;
}

void link_glides(std::vector<FormNote>& notes) {
    if (!has_glides(notes)) return;
    for (const auto& [voice, line] : voices_of(notes)) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            Note& note = line[i]->note;
            const Note& next = line[i + 1]->note;
            if (note.glide.ticks == 0 || note.onset + note.duration != next.onset) continue;
            note.glide.semitones = static_cast<float>(next.key - note.key);
            note.is_sliding = note.glide.semitones != 0;
        }
    }
}

void reverse(Block& block) {
    turn_phrases(block.notes);
    turn_glides(block.notes);
    for (FormNote& one : block.notes) {
        one.note.onset = block.length - one.note.onset - one.note.duration;
        std::swap(one.note.from, one.note.to);
    }
    sort(block.notes);
    for (std::int64_t& end : block.ends) end = block.length - end;
    std::reverse(block.ends.begin(), block.ends.end());
}

Block in_form(const Block& block, const Grammar& grammar, const Melody& melody, const std::vector<FormSection>& form,
              std::span<const std::int64_t> ends) {
    std::vector<std::int64_t> borders = begins_of(block);
    // The last sub-curve breathes like the others if more follows it.
    borders.push_back(block.next);
    // A rest after the last sub-curve is not a section.
    const std::int64_t tail = borders[borders.size() - 2];
    const bool has_tail = std::any_of(block.notes.begin(), block.notes.end(), [&](const FormNote& one) {
        return !is_chord(one, block, melody) && one.note.onset >= tail;
    });
    if (!has_tail && borders.size() > 2) borders.pop_back();
    Block result;
    result.chords_from = block.chords_from;
    std::size_t section_begin = 0;  // first note of the section before
    std::int64_t end_before = 0;    // its end, without the rest before the next bar line
    std::vector<FormSection> order = form;
    if (melody.layout.is_retrograde) std::reverse(order.begin(), order.end());
    for (const FormSection& section : order) {
        const auto at = static_cast<std::size_t>(section.letter);
        if (at + 1 >= borders.size()) refuse_section(grammar, melody, form, section, borders.size() - 1);
        Block piece = cut_section(block, borders[at], borders[at + 1], melody);
        if (melody.layout.is_retrograde) reverse_section(piece, melody);
        change_section(piece, melody, section);
        if (!ends.empty()) fit(piece, ends[result.ends.size()] - result.length);
        const std::int64_t bar_line = first_bar_line(melody, section);
        trim_chords(piece, melody, bar_line);
        // A chord continues during the upbeat of the next section if this follows at once.
        if (bar_line > 0) {
            const std::int64_t next = result.length + first_chord(piece, melody, bar_line);
            end_chords(result, melody, section_begin, end_before < result.length ? end_before : next);
        }
        section_begin = result.notes.size();
        const bool is_last = &section == &order.back();
        end_on(piece, melody, ending_of(piece, melody, section, is_last));
        if (section.is_korvai && is_last && ends.empty()) land(piece, melody);
        if (piece.notes.size() > most_block_notes - result.notes.size()) {
            throw ScoreError(fmt::format("the form would have more than {} notes", most_block_notes));
        }
        for (FormNote one : piece.notes) {
            one.note.onset += result.length;
            result.notes.push_back(one);
        }
        result.length += piece.length;
        end_before = result.length;
        // The next section begins at a bar line. The sections of a bass have the length of those above it.
        if (ends.empty() && !is_last) {
            const std::int64_t bar = melody.meter.bar();
            result.length = (result.length + bar - 1) / bar * bar;
        }
        result.ends.push_back(result.length);
    }
    const std::size_t last = borders.size() - 2;
    if (ends.empty() && static_cast<std::size_t>(order.back().letter) == last && !order.back().is_korvai) {
        const std::int64_t rest = std::max<std::int64_t>(0, borders.back() - end_of_sections(block, melody));
        result.length -= order.back().augmentation.of(rest);
        result.ends.back() = result.length;
    }
    result.melody_end = result.length;
    for (const FormNote& one : result.notes)
        result.length = std::max(result.length, one.note.onset + one.note.duration);
    return result;
}

void thin_out(Block& block, const Melody& melody, double share) {
    const Phrases phrases(block);
    const std::int64_t bar = melody.meter.bar();
    const auto beat = std::llround(beat_unit(melody.meter).quarters * static_cast<double>(ticks_per_quarter));
    std::set<std::int64_t> strong, beats;
    for (const std::int64_t tick : strong_beats(melody.meter)) strong.insert(tick);
    std::int64_t group_begin = 0;
    for (const std::int64_t group : groups_of(melody.meter)) {
        // In additive meters, each group is one beat.
        for (std::int64_t tick = 0; tick < group; tick += std::max<std::int64_t>(beat, 1)) {
            if (tick == 0 || !has_groups(melody.meter)) beats.insert(group_begin + tick);
        }
        group_begin += group;
    }
    const auto moves = [&](const FormNote& one) { return one.has_degree && !is_chord(one, block, melody); };
    std::map<std::pair<int, std::size_t>, std::int64_t> last;  // onset of the last note of a voice in a phrase
    std::vector<std::int64_t> ends(phrases.count(), 0);        // of the last notes, without the rests after them
    for (const FormNote& one : block.notes) {
        if (!moves(one)) continue;
        const std::size_t phrase = phrases.at(one.note.onset);
        last[{one.note.voice, phrase}] = one.note.onset;
        ends[phrase] = std::max(ends[phrase], one.note.onset + one.note.duration);
    }
    std::map<int, std::pair<std::size_t, std::size_t>> before;  // by voice: note kept before, its phrase
    std::vector<FormNote> kept;
    for (const FormNote& one : block.notes) {
        if (!moves(one)) {
            kept.push_back(one);
            continue;
        }
        const Note& note = one.note;
        const std::size_t phrase = phrases.at(note.onset);
        const std::int64_t begin = phrases.begin(phrase);
        const std::int64_t end = ends[phrase];
        const double left = static_cast<double>(end - note.onset) / static_cast<double>(end - begin);
        const bool stays = left > share || note.onset == last[{note.voice, phrase}] ||
                           (left > share / 2 ? beats : strong).contains((note.onset + melody.begin()) % bar);
        const auto held = before.find(note.voice);
        const bool continues = held != before.end() && held->second.second == phrase;
        if (!stays && continues) {
            Note& longer = kept[held->second.first].note;
            if (longer.onset + longer.duration == note.onset) longer.duration += note.duration;
        }
        if (!stays) continue;
        before[note.voice] = {kept.size(), phrase};
        kept.push_back(one);
    }
    block.notes = std::move(kept);
}

void raise_to_climax(Block& block, const Melody& melody, double share) {
    const Phrases phrases(block);
    const auto phrase_at = [&](std::int64_t tick) { return phrases.at(tick); };
    std::vector<std::set<std::int64_t>> degrees(phrases.count());
    for (const FormNote& one : block.notes) {
        if (one.has_degree) degrees[phrase_at(one.note.onset)].insert(one.degree);
    }
    const auto phrase_after = [&](double part) {
        const auto last = static_cast<double>(std::max<std::int64_t>(block.length - 1, 0));
        return phrase_at(static_cast<std::int64_t>(std::clamp(part, 0.0, 1.0) * last));
    };
    // The phrase near the place that is highest already.
    std::size_t goal = phrase_after(share);
    for (std::size_t i = phrase_after(share - 0.05); i <= phrase_after(share + 0.05); ++i) {
        if (degrees[i].empty()) continue;
        if (degrees[goal].empty() || *degrees[i].rbegin() > *degrees[goal].rbegin()) goal = i;
    }
    if (degrees[goal].empty()) {
        throw ScoreError(fmt::format(
            "climax: no note that can move lies {:.0f} % into the part; another place may help", 100 * share));
    }
    const std::size_t farthest = std::max(goal, phrases.count() - 1 - goal) + 1;
    const auto raised_by = [&](std::size_t phrase, std::int64_t most) {
        const std::size_t apart = phrase > goal ? phrase - goal : goal - phrase;
        const auto near = static_cast<std::int64_t>(farthest - apart), far = static_cast<std::int64_t>(2 * farthest);
        return apart == 0 ? most : most * near / far;
    };
    const auto range = bounds_of(melody);
    const auto highest_key = [&](std::size_t phrase, std::int64_t most) {
        double highest = -1;
        for (std::int64_t degree : degrees[phrase]) {
            degree += raised_by(phrase, most);
            for (const bool falling : {false, true}) {
                highest = std::max(highest, key_moved_to(melody, range, degree, falling));
            }
        }
        return highest;
    };
    const auto is_climax = [&](std::int64_t most) {
        const double top = highest_key(goal, most);
        for (std::size_t i = 0; i < degrees.size(); ++i) {
            if (i != goal && highest_key(i, most) >= top) return false;
        }
        return true;
    };
    const auto period = static_cast<std::int64_t>(melody.scale.size());
    // At most 48 trials, also in scales of many notes.
    const std::int64_t step = std::max<std::int64_t>(1, period / 24);
    std::int64_t most = 0;
    while (most <= 2 * period && !is_climax(most)) most += step;
    if (most > 2 * period) {
        throw ScoreError(
            fmt::format("climax: the phrase {:.0f} % into the part cannot have the highest note, even two octaves "
                        "higher; a wider `range` or another place may help",
                        100 * share));
    }
    move_notes(block.notes, melody,
               [&](const FormNote& one) { return one.degree + raised_by(phrase_at(one.note.onset), most); });
}

void add_drone(Block& block, const Melody& melody, int first_voice) {
    if (first_voice == 0) first_voice = melody.own_voices();
    const mapping::Accompaniment drone(melody);
    const std::int64_t bar = melody.meter.bar();
    block.length = (block.length + bar - 1) / bar * bar;
    for (std::int64_t begin = melody.layout.opening(); begin < block.length; begin += bar) {
        if (block.notes.size() >= most_block_notes) {
            throw ScoreError(fmt::format("the drone would have more than {} notes", most_block_notes));
        }
        for (Note note : drone.bar(begin, nullptr)) {
            note.voice = static_cast<std::int16_t>(note.voice + first_voice);
            if (note.onset >= block.length) continue;
            note.duration = std::min(note.duration, block.length - note.onset);
            block.notes.push_back({note, 0, false});
        }
    }
    sort(block.notes);
}

void end_on(Block& block, const Melody& melody, Ending ending) {
    if (ending == Ending::none) return;
    std::vector<FormNote*> last;  // in reverse order
    for (auto one = block.notes.rbegin(); one != block.notes.rend() && last.size() < notes_of_ending; ++one) {
        if (one->has_degree && one->note.voice == 0) last.push_back(&*one);
    }
    if (last.empty()) return;
    last[0]->note.glide = {};
    last[0]->note.is_sliding = false;
    const auto period = static_cast<std::int64_t>(melody.scale.size());
    const std::int64_t place = ending == Ending::open ? fifth_degree(melody.scale) : 0;
    const std::int64_t nearest = mapping::goal_near(last[0]->degree, place, period, std::nullopt);
    const std::int64_t side = last.size() > 1 && last[1]->degree < nearest ? -1 : 1;
    const auto range = bounds_of(melody);
    // Answers of a canon lie within the range moved by the interval.
    const std::int64_t answer = melody.answer;
    const std::int64_t goal = mapping::goal_near(last[0]->degree, place, period, range, answer);
    for (std::size_t i = 0; i < last.size(); ++i) {
        last[i]->degree = goal + side * static_cast<std::int64_t>(i);
        if (range) last[i]->degree = range->inside(last[i]->degree - answer) + answer;
        last[i]->note.key = key_within(melody, last[i]->degree, side > 0);
    }
    const Note goal_note = last[0]->note;
    close_chords(block, melody, goal_note, ending);
}

void scale_times(Note& note, Ratio by) {
    const std::int64_t end = by.of(note.onset + note.duration);
    if (note.glide.ticks > 0) note.glide.ticks = end - by.of(note.onset + note.duration - note.glide.ticks);
    note.onset = by.of(note.onset);
    note.duration = std::max<std::int64_t>(1, end - note.onset);
}

void scale_times(Block& block, Ratio by) {
    if (by.is_one()) return;
    for (FormNote& one : block.notes) scale_times(one.note, by);
    for (std::int64_t& end : block.ends) end = by.of(end);
    block.length = by.of(block.length);
    block.melody_end = by.of(block.melody_end);
}

double key_within(const Melody& melody, std::int64_t degree, bool falling) {
    const double key = melody.key(degree, falling).value_or(melody.tonic);
    if (melody.answer == 0) return mapping::folded(melody, key);
    const double led = melody.key(degree - melody.answer, falling).value_or(melody.tonic);
    return std::clamp(mapping::folded(melody, led) + key - led, 0.0, 127.0);
}

}  // namespace sikku
