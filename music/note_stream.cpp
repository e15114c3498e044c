#include "music/note_stream.h"

#include "music/ensemble.h"
#include "music/excerpt.h"
#include "music/form/block.h"
#include "music/humaniser.h"
#include "music/performance.h"
#include "music/players.h"
#include "music/score/glides.h"
#include "music/score/music_page.h"
#include "music/score/note_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t least_span = 16 * ticks_per_quarter;

class Stream : public NoteStream {
public:
    Stream(StreamedScore score, Ensemble ensemble, const PlayOptions& playing)
        : score_(std::move(score)), ensemble_(std::move(ensemble)), playing_(playing) {}
    const ScoreHead& head() const override { return score_.head; }
    const MidiOptions& midi() const override { return score_.midi; }

protected:
    StreamedScore score_;
    Ensemble ensemble_;
    PlayOptions playing_;
};

/// Adds the slide of a note from a tick on.
void add_pitches(const Note& note, double tempo, std::int64_t from, NoteWindow& window) {
    if (note.glide.ticks == 0) return;
    for (const GlidePoint& point : glide_points(note, tempo)) {
        if (point.tick >= from) window.pitches.push_back({point.tick, note.voice, point.key});
    }
}

void sort_pitches(NoteWindow& window) {
    std::stable_sort(window.pitches.begin(), window.pitches.end(),
                     [](const NoteWindow::Pitch& a, const NoteWindow::Pitch& b) { return a.tick < b.tick; });
}

bool comes_before(const ControlPoint& a, const ControlPoint& b) {
    return a.tick < b.tick;
}

/// Remembers the last values of controllers, to add them at a tick.
class LastControls {
public:
    void add(const ControlPoint& point) {
        if (point.number != ControlPoint::bend) last_[{point.voice, point.number}] = point;
    }
    void put(std::int64_t tick, std::vector<ControlPoint>& points) const {
        for (auto [key, point] : last_) {
            point.tick = tick;
            points.push_back(point);
        }
    }

private:
    std::map<std::pair<int, int>, ControlPoint> last_;  // by voice and number
};

/// Adds the changes of tempo within a window to it; the first applies at its beginning.
void add_tempos(const std::vector<TempoPoint>& tempos, NoteWindow& window) {
    const auto is_before = [](std::int64_t tick, const TempoPoint& point) { return tick < point.tick; };
    auto next = std::upper_bound(tempos.begin(), tempos.end(), window.from, is_before);
    if (next != tempos.begin()) window.tempos.push_back({window.from, std::prev(next)->factor});
    for (; next != tempos.end() && next->tick < window.to; ++next) window.tempos.push_back(*next);
}

/// Streams a score whose notes are all in memory.
class WholeStream final : public Stream {
public:
    WholeStream(StreamedScore score, Ensemble ensemble, const PlayOptions& playing)
        : Stream(std::move(score), std::move(ensemble), playing) {
        NoteCollector collector(most_block_notes);
        end_ = perform(ensemble_, playing_, ExpressionSink::Use::performance, score_.human, collector).end;
        notes_ = collector.notes();
        curves_ = collector.curves();
        sort_by_time(notes_);
        std::stable_sort(curves_.controls.begin(), curves_.controls.end(), comes_before);
    }

    void seek(std::int64_t tick) override {
        at_ = tick;
        is_sought_ = true;
    }

    NoteWindow next() override {
        NoteWindow window;
        window.from = at_;
        window.end = end_;
        window.is_last = end_ - at_ <= least_span;
        window.to = window.is_last ? std::max(at_, end_) : at_ + least_span;
        const auto before = [](const Note& note, std::int64_t tick) { return note.onset < tick; };
        const auto first = std::lower_bound(notes_.begin(), notes_.end(), window.from, before);
        const auto last = window.is_last ? notes_.end() : std::lower_bound(first, notes_.end(), window.to, before);
        window.notes.assign(first, last);
        for (const Note& note : window.notes) add_pitches(note, score_.head.tempo, 0, window);
        sort_pitches(window);
        add_controls(window);
        add_tempos(curves_.tempo, window);
        at_ = window.is_last ? 0 : window.to;
        is_sought_ = window.is_last;
        return window;
    }

private:
    void add_controls(NoteWindow& window) const {
        const auto& all = curves_.controls;
        const auto first = std::lower_bound(all.begin(), all.end(), ControlPoint{window.from}, comes_before);
        const auto last =
            window.is_last ? all.end() : std::lower_bound(first, all.end(), ControlPoint{window.to}, comes_before);
        if (is_sought_) {
            LastControls before;
            std::for_each(all.begin(), first, [&](const ControlPoint& point) { before.add(point); });
            before.put(window.from, window.controls);
        }
        window.controls.insert(window.controls.end(), first, last);
    }

    std::vector<Note> notes_;
    Curves curves_;  // by tick
    std::int64_t end_ = 0;
    std::int64_t at_ = 0;
    bool is_sought_ = true;
};

/// Keeps the notes of one window, and the ends of notes that were not known before.
class WindowSink : public NoteSink {
public:
    struct Place {
        double tempo;
        std::int64_t begin;        ///< tick of the first note that may come
        std::int64_t known_until;  ///< ends from here on were not known before
        std::int64_t until;        ///< tick after which nothing is known; INT64_MAX if the score ends there
        bool is_sought;            ///< the window does not continue the one before
    };

    /// @param open  by voice: true if the end of its last note is not known
    WindowSink(NoteWindow& window, std::vector<char> open, const Place& place)
        : window_(window), open_(std::move(open)), place_(place) {}

    void controls(std::span<const ControlPoint> points) override {
        for (ControlPoint point : points) {
            point.tick += place_.begin;
            const auto voice = static_cast<std::size_t>(point.voice);
            if (voice >= coming_.size()) coming_.resize(voice + 1);
            coming_[voice].push_back(point);
        }
    }

    void notes(std::span<const Note> notes) override {
        for (Note note : notes) {
            note.onset += place_.begin;
            take_controls(note);
            if (note.onset >= window_.to) continue;
            const auto voice = static_cast<std::size_t>(note.voice);
            if (voice >= still_open_.size()) still_open_.resize(voice + 1, 0);
            if (voice >= open_.size()) open_.resize(voice + 1, 0);
            const std::int64_t end = note.onset + note.duration;
            if (note.onset < window_.from) {
                if (open_[voice] == 0 || end < place_.known_until) continue;
                open_[voice] = 0;
                add_pitches(note, place_.tempo, place_.known_until, window_);
                if (end < place_.until) {
                    window_.ends.push_back({end, note.voice});
                } else {
                    still_open_[voice] = 1;
                }
                continue;
            }
            add_pitches(note, place_.tempo, 0, window_);
            if (end >= place_.until) {
                note.duration = 0;
                still_open_[voice] = 1;
            }
            if (window_.notes.size() >= most_block_notes) {
                throw ScoreError(
                    fmt::format("more than {} notes in a few bars do not fit into memory", most_block_notes));
            }
            window_.notes.push_back(note);
        }
    }
    void finish(std::int64_t) override {}

    /// Sorts the contents of the window. @return voices whose last note has no known end
    std::vector<char> complete() {
        // An open note that did not come again ends at the beginning of the window.
        for (std::size_t voice = 0; voice < open_.size(); ++voice) {
            if (open_[voice] != 0) window_.ends.push_back({window_.from, static_cast<std::int16_t>(voice)});
        }
        sort_by_time(window_.notes);
        sort_pitches(window_);
        std::vector<ControlPoint> points;
        if (place_.is_sought) before_.put(window_.from, points);
        points.insert(points.end(), window_.controls.begin(), window_.controls.end());
        std::stable_sort(points.begin(), points.end(), comes_before);
        window_.controls = std::move(points);
        std::sort(window_.ends.begin(), window_.ends.end(), [](const NoteWindow::End& a, const NoteWindow::End& b) {
            return std::tie(a.tick, a.voice) < std::tie(b.tick, b.voice);
        });
        return std::move(still_open_);
    }

private:
    /// Points belong to the window in which their note begins. After a jump, points of sounding notes are included.
    void take_controls(const Note& note) {
        const auto voice = static_cast<std::size_t>(note.voice);
        if (voice >= coming_.size()) return;
        std::vector<ControlPoint>& points = coming_[voice];
        auto next = points.begin();
        for (; next != points.end() && next->tick < note.onset + note.duration; ++next) {
            if (next->tick <= window_.from && note.onset < window_.from) {
                before_.add(*next);
            } else if (note.onset < window_.to && (place_.is_sought || note.onset >= window_.from)) {
                window_.controls.push_back(*next);
            }
        }
        points.erase(points.begin(), next);
    }

    NoteWindow& window_;
    std::vector<char> open_;
    Place place_;
    std::vector<char> still_open_;
    std::vector<std::vector<ControlPoint>> coming_;  // by voice, points of the notes to come
    LastControls before_;
};

/// Plays one window at a time. The score is read from a little before it to a little after it, for the context of its
/// first notes and the ends of its last.
class WindowStream final : public Stream {
public:
    WindowStream(StreamedScore score, Ensemble ensemble, const PlayOptions& playing, std::int64_t grid)
        : Stream(std::move(score), std::move(ensemble), playing), grid_(grid) {
        for (const Player& player : ensemble_.players) {
            const Ratio tempo = player.melody.layout.tempo;
            lead_ = std::max(lead_, 2 * Ratio{tempo.below, tempo.above}.of(player.melody.meter.bar()));
        }
        if (ensemble_.has_expression()) measure();
        const auto on_grid = [this](std::int64_t ticks) { return (ticks + grid_ - 1) / grid_ * grid_; };
        span_ = on_grid(least_span);
        after_ = on_grid(std::max(2 * ensemble_.meter.bar(), lead_));
    }

    void seek(std::int64_t tick) override {
        at_ = tick;
        open_.clear();
        is_sought_ = true;
        is_silent_ = tick == 0;
        end_ = tick;
    }

    NoteWindow next() override {
        NoteWindow window;
        window.from = at_;
        window.to = (at_ / span_ + 1) * span_;
        const std::int64_t begin = std::max<std::int64_t>(0, at_ - lead_) / grid_ * grid_;
        PlayOptions options = playing_;
        options.from = playing_.from + begin;
        options.to = std::min(playing_.to, playing_.from + window.to + after_);
        const std::int64_t until = options.to - playing_.from;
        const bool is_cut = options.to == playing_.to;
        WindowSink sink(
            window, std::move(open_),
            {score_.head.tempo, begin, known_until_, is_cut ? INT64_MAX : until, std::exchange(is_sought_, false)});
        EnsembleReport report;
        std::vector<TempoPoint> tempos;
        if (options.from < options.to) {
            Humaniser humaniser(sink, score_.human.amount, score_.human.seed, options.from);
            NoteSink& to = score_.human.amount > 0 ? static_cast<NoteSink&>(humaniser) : sink;
            report = play_piece(options, to, tempos);
        }
        open_ = sink.complete();
        known_until_ = until;
        is_silent_ = is_silent_ && window.notes.empty();
        if (report.end > 0) end_ = std::max(end_, begin + report.end);
        if (is_cut || (begin + report.end < until && !has_later_part(options.to))) {
            window.end = end_;
            window.is_last = end_ <= window.to;
        }
        if (window.is_last) {
            window.to = std::max(window.from, end_);
            if (is_silent_) {
                NullSink nobody;
                play_all(ensemble_, playing_, nobody);  // throws the reason
            }
            seek(0);
        } else {
            at_ = window.to;
        }
        for (TempoPoint& point : tempos) point.tick += begin;
        add_tempos(tempos, window);
        return window;
    }

private:
    /// Measures the ranges of the sources of curves of expression. @throws as play_all()
    void measure() {
        constexpr std::int64_t tempo_margin = 4 * ticks_per_quarter;  // tempo is smoothed over two quarters
        lead_ = std::max(lead_, tempo_margin);
        grid_ = std::lcm(grid_, ticks_per_quarter);
        measured_.emplace(ensemble_, ExpressionSink::Use::pieces);
        measured_->fold_ranges();
        if (!measured_->needs_ranges()) return;
        try {
            play_all(ensemble_, playing_, *measured_);
        } catch (const BudgetError& error) {
            throw BudgetError(
                fmt::format("curves of expression need the least and greatest value in the whole score before it "
                            "begins, but {}; 'bars' 64 plays a piece of it",
                            error.what()));
        }
    }

    EnsembleReport play_piece(const PlayOptions& options, NoteSink& sink, std::vector<TempoPoint>& tempos) const {
        if (!measured_) return play_parts(ensemble_, options, sink);
        ExpressionSink expressive(*measured_, sink);
        EnsembleReport report = play_parts(ensemble_, options, expressive);
        expressive.finish(report.end);
        tempos = expressive.tempos(report.end);
        return report;
    }

    bool has_later_part(std::int64_t tick) const {
        return std::any_of(ensemble_.players.begin(), ensemble_.players.end(), [&](const Player& player) {
            return start_of(player, ensemble_.meter, ensemble_) >= tick;
        });
    }

    std::optional<ExpressionSink> measured_;
    std::int64_t grid_;  // distance of ticks at which all parts have whole ticks
    std::int64_t lead_ = ticks_per_quarter;
    std::int64_t span_ = 0;
    std::int64_t after_ = 0;
    std::int64_t at_ = 0;
    std::int64_t end_ = 0;
    std::int64_t known_until_ = 0;
    bool is_silent_ = true;
    bool is_sought_ = true;   // the next window does not continue the one before
    std::vector<char> open_;  // voices whose last note has no known end
};

/// Largest distance of ticks at which all parts have whole ticks.
constexpr std::int64_t most_grid = 64 * ticks_per_quarter;

/// Distance of the ticks of the score, from the beginning of the piece on, at which all parts have whole ticks of
/// their own; 0 if there are none.
std::int64_t grid_of(const Ensemble& ensemble, const PlayOptions& playing) {
    std::int64_t grid = 1;
    for (const Player& player : ensemble.players) {
        const Ratio tempo = player.melody.layout.tempo;
        if (tempo.is_one()) continue;
        const std::int64_t part = tempo.below / std::gcd(tempo.above, tempo.below);
        if ((playing.from - start_of(player, ensemble.meter, ensemble)) % part != 0) return 0;
        if (part > most_grid) return 0;
        grid = std::lcm(grid, part);
        if (grid > most_grid) return 0;
    }
    return grid;
}

/// True if any bars of the part can be read without the others.
bool has_windows(const Player& player) {
    const Grammar& grammar = player.document.grammar();
    const Melody& melody = player.melody;
    if (!grammar.is_plain() || grammar.whole_word_steps() > 0) return false;
    if (melody.branches != Branches::sequence && has_brackets(grammar)) return false;
    if (melody.is_sequential()) return false;
    switch (melody.anchor) {
        case Anchor::first_note:
            return true;
        case Anchor::piece:
            return melody.mapping != Mapping::counterpoint;
        default:
            return census(grammar, melody).has_value();
    }
}

}  // namespace

std::unique_ptr<NoteStream> stream_notes(StreamedScore score, Ensemble ensemble, const PlayOptions& playing) {
    const std::int64_t grid = grid_of(ensemble, playing);
    const bool depends_on_context = playing.is_excerpt() && depends_on_whole(ensemble) && is_soon_played(ensemble);
    const bool is_whole = depends_on_context || ensemble.needs_whole() || ensemble.close == Close::fermata ||
                          grid == 0 || !std::all_of(ensemble.players.begin(), ensemble.players.end(), has_windows);
    if (is_whole) return std::make_unique<WholeStream>(std::move(score), std::move(ensemble), playing);
    ensemble = with_fixed_anchors(std::move(ensemble), playing);
    auto stream = std::make_unique<WindowStream>(std::move(score), std::move(ensemble), playing, grid);
    // A score that cannot be played is refused now.
    stream->next();
    stream->seek(0);
    return stream;
}

}  // namespace sikku
