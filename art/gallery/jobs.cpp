#include "art/gallery/jobs.h"

#include "art/gallery/items.h"
#include "art/gallery/patterns.h"
#include "art/gallery/summary.h"
#include "art/gallery/values.h"
#include "art/product/draw_settings.h"

#include "engine/base/input_file.h"
#include "engine/base/keys.h"
#include "engine/base/numbers.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <unordered_map>

namespace sikku {
namespace {

/// True if a file or folder with that path would collide with the records of galleries.
bool is_record(const std::string& name, const std::string& file) {
    const std::string first = (name.find('/') == std::string::npos ? file : name).substr(0, name.find('/'));
    return first.starts_with("gallery") && first.ends_with(".jsonl");
}

/// Converts a value to a part of a file's name.
std::string name_part(std::string_view value) {
    std::string part;
    for (const char letter : value) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.' || letter == '_' ||
                           letter == '+' || letter == '-' || (static_cast<unsigned char>(letter) & 0x80) != 0;
        if (plain) {
            part += letter;
        } else if (!part.empty() && part.back() != '-') {
            part += '-';
        }
    }
    while (part.ends_with('-')) part.pop_back();
    return part;
}

/// Compiles patterns with the changes of jobs, each combination once.
class Compilations {
public:
    struct Result {
        std::string problem;  ///< reason why the pattern cannot be compiled; empty if it can
        std::string steps;    ///< else the derivation length
    };

    const Result& of(const GalleryJob& job) {
        std::string key = fmt::format("{}", static_cast<const void*>(job.pattern.get()));
        const auto add = [&](const std::string& piece) { key += fmt::format(":{}:{}", piece.size(), piece); };
        for (const char* name : {"variant", "n"}) add(job.keys.contains(name) ? job.keys.at(name) : "");
        // Any seed of up to 18 digits will do.
        const auto seed = job.keys.find("seed");
        add(seed != job.keys.end() && seed->second.size() > 18 ? seed->second : "");
        for (const auto& [name, value] : job.overrides) {
            add(name);
            add(value);
        }
        const std::vector<Setting> settings = job.key_settings();
        for (const Setting& setting : settings) {
            add(setting.key);
            add(setting.value);
        }
        const auto found = known_.find(key);
        if (found != known_.end()) return found->second;
        bytes_ += key.size();
        if (bytes_ > most_bytes) {
            known_.clear();
            bytes_ = key.size();
        }
        return known_.emplace(std::move(key), compile(job, settings)).first->second;
    }

private:
    static Result compile(const GalleryJob& job, const std::vector<Setting>& settings) {
        try {
            const Document document = job.document();
            if (!settings.empty()) {
                Diagnostics diagnostics;
                job.interpreter().check_keys(document.with(settings).pattern(), diagnostics);
                diagnostics.throw_if_errors();
            }
            return {"", fmt::format("{}", document.grammar().steps())};
        } catch (const std::runtime_error& error) {
            std::string message = error.what();
            while (message.ends_with('\n')) message.pop_back();
            return {message.empty() ? "the pattern does not accept this setting" : message, ""};
        }
    }

    static constexpr std::size_t most_bytes = std::size_t{1} << 24;
    std::unordered_map<std::string, Result> known_;
    std::size_t bytes_ = 0;  // size of their keys
};

/// A key of jobs, with its effect on them.
struct Choice {
    GalleryItem::Axis axis;
    std::string target;        ///< the pattern's key, where it sets one
    bool is_flag = false;      ///< false is the same as absent
    bool has_default = false;  ///< true stands for the default value
};

/// A name template, `{pattern}-n{n}`, split at its placeholders.
class NameForm {
public:
    struct Piece {
        std::string text;  ///< literal text, or the contents of braces
        bool is_placeholder = false;
    };

    explicit NameForm(const GalleryItem& item) {
        if (!item.name) return;
        const std::string& form = *item.name;
        for (std::size_t i = 0; i < form.size();) {
            const bool is_placeholder = form[i] == '{';
            const std::size_t end = form.find(is_placeholder ? '}' : '{', i);
            if (is_placeholder && end == std::string::npos) fail(item.name_place, "name: '{' without '}'");
            const std::size_t begin = is_placeholder ? i + 1 : i;
            pieces_.push_back({form.substr(begin, std::min(end, form.size()) - begin), is_placeholder});
            i = is_placeholder ? end + 1 : std::min(end, form.size());
        }
    }
    const std::vector<Piece>& pieces() const { return pieces_; }

private:
    std::vector<Piece> pieces_;
};

/// Makes the jobs of items.
class Expansion {
public:
    Expansion(std::vector<GalleryItem> items, const GalleryRequest& request, const GalleryKeys& keys)
        : items_(std::move(items)),
          keys_(keys),
          monitor_(request.monitor),
          shelf_(request.bundled_only, keys.pieces(), monitor_) {
        patterns_.reserve(items_.size());
        for (const GalleryItem& item : items_) patterns_.push_back(patterns_of(item));
    }

    /// Counts the jobs of all items before anything is expanded. Time: linear in the keys of all items. @throws
    /// GalleryError if there are too many
    void require_few(double most_jobs) const {
        double sum = 0;
        double settings = 0;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            watch();
            std::map<const Interpreter*, double> products;
            for (const Interpreter* interpreter : keys_.interpreters()) {
                products[interpreter] = product_of(items_[i], *interpreter);
            }
            for (const auto& pattern : *patterns_[i]) {
                for (const std::string& format : formats_of(items_[i], *pattern)) {
                    const double jobs = products.at(&keys_.interpreter_of(format));
                    sum += jobs;
                    settings += jobs * static_cast<double>(items_[i].axes.size());
                }
            }
            if (sum > most_jobs) {
                fail(items_[i].place,
                     fmt::format("this would make {} jobs; at most {:.0f} fit in one run",
                                 sum < 1e15 ? fmt::format("{:.0f}", sum) : fmt::format("{:.0e}", sum), most_jobs));
            }
            if (settings > most_gallery_settings) {
                fail(items_[i].place,
                     fmt::format("this would make jobs with {:.0f} settings in total; at most {:.0f} are allowed",
                                 settings, most_gallery_settings));
            }
        }
    }

    std::vector<GalleryJob> jobs() {
        std::vector<GalleryJob> list;
        for (std::size_t i = 0; i < items_.size(); ++i) {
            const NameForm form(items_[i]);
            for (const auto& pattern : *patterns_[i]) {
                for (const std::string& format : formats_of(items_[i], *pattern)) {
                    expand(items_[i], form, pattern, format, list);
                }
            }
        }
        std::unordered_map<std::string, const GalleryJob*> names;
        names.reserve(list.size());
        for (const GalleryJob& job : list) {
            const auto [known, is_new] = names.emplace(job.file(), &job);
            if (is_new) continue;
            const std::string& other = known->second->place;
            fail(job.place, fmt::format("two jobs are named '{}'{}; `name` can tell them apart", job.file(),
                                        other.empty() || other == job.place ? "" : " (the other: " + other + ")"));
        }
        return list;
    }

private:
    static constexpr double most_gallery_settings = 20'000'000;

    void watch() const {
        if (++watched_ % 256 == 0) monitor_.check();
    }

    PatternShelf::List patterns_of(const GalleryItem& item) {
        watch();
        if (!item.patterns) {
            if (item.needs_pattern) fail(item.place, "this item has no pattern");
            if (!all_) all_ = shelf_.all();
            return all_;
        }
        if (item.patterns->size() == 1) return shelf_.find(item.patterns->front(), item.folder, item.patterns_place);
        // Items that share a list of words share the results.
        PatternShelf::List& list = found_[{item.patterns, item.folder}];
        if (list) return list;
        std::vector<PatternShelf::Pointer> found;
        std::set<const GalleryPattern*> seen;
        for (const std::string& word : *item.patterns) {
            for (const auto& pattern : *shelf_.find(word, item.folder, item.patterns_place)) {
                if (seen.insert(pattern.get()).second) found.push_back(pattern);
            }
        }
        list = std::make_shared<const std::vector<PatternShelf::Pointer>>(std::move(found));
        return list;
    }

    static const std::vector<std::string>& formats_of(const GalleryItem& item, const GalleryPattern& pattern) {
        static const std::vector<std::string> print = {"svg"};
        static const std::vector<std::string> both = {"svg", "mid"};
        static const std::vector<std::string> score = {"mid"};
        if (!item.formats.empty()) return item.formats;
        if (pattern.is_piece) return score;
        return pattern.kind == "melodies" ? both : print;
    }

    bool matters(const GalleryAxis& axis, const Interpreter& interpreter) const {
        if (axis.in_set) return true;
        const Interpreter* use = keys_.find(axis.key)->use;
        return !use || use == &interpreter;
    }

    double product_of(const GalleryItem& item, const Interpreter& interpreter) const {
        double product = 1;
        for (const GalleryItem::Axis& axis : item.axes) {
            if (axis->count() > 1 && matters(*axis, interpreter)) product *= axis->count();
        }
        return product;
    }

    /// The key of the pattern that `angle` stands for.
    std::string override_key(const std::string& key, const GalleryPattern& pattern) {
        if (key == "angle") {
            const auto [known, is_new] = defines_angle_.emplace(&pattern, true);
            if (is_new && pattern.text) {
                Diagnostics ignored;
                const Pattern parsed = parse_pattern(pattern.text->name, pattern.text->text, ignored);
                known->second = std::any_of(parsed.defines.begin(), parsed.defines.end(),
                                            [](const Define& define) { return define.name.view() == "angle"; });
            }
            return known->second ? key : "angle increment";
        }
        std::string name = key;
        std::replace(name.begin(), name.end(), '-', ' ');
        return name;
    }

    /// The tracks of a piece set the keys of their patterns, and a piece is not drawn. @throws GalleryError
    void check_piece(const GalleryItem& item, const GalleryPattern& piece, const std::string& format) const {
        const Interpreter& player = *keys_.pieces().interpreter;
        const std::string name = printable(piece.shown, 200);
        if (&keys_.interpreter_of(format) != &player) {
            fail(item.place, fmt::format("{}: '{}' is an arrangement, which has no drawing; its formats are "
                                         "those of scores, such as mid and wav",
                                         format, name));
        }
        for (const GalleryItem::Axis& axis : item.axes) {
            if (!matters(*axis, player)) continue;
            const GalleryKey* row = axis->in_set ? nullptr : keys_.find(axis->key);
            const bool is_of_pattern =
                !row || row->overrides || axis->key == "n" || axis->key == "seed" || axis->key == "variant";
            if (!is_of_pattern) continue;
            const bool is_option = !row && find_option(player.options(), axis->key);
            fail(axis->place.empty() ? item.place : axis->place,
                 fmt::format("{}: '{}' is an arrangement, whose tracks set the keys of their patterns{}",
                             printable(axis->key, 80), name,
                             is_option ? fmt::format("; '{}' without 'set' applies to all tracks", axis->key) : ""));
        }
    }

    /// @throws GalleryError if a key of `set` is also set by a key of the gallery
    void check_sets(const GalleryItem& item, const GalleryPattern& pattern) {
        for (const GalleryItem::Axis& axis : item.axes) {
            if (!axis->in_set) continue;
            for (const GalleryItem::Axis& other : item.axes) {
                if (other->in_set) continue;
                const std::string key = other->key == "n" ? "derivation length" : override_key(other->key, pattern);
                const GalleryKey* known = keys_.find(other->key);
                const bool sets_key = find_language_key(key) || (known && known->overrides);
                if (key != axis->key || !sets_key) continue;
                fail(axis->place.empty() ? item.place : axis->place,
                     fmt::format("'{}' and '{}' in 'set' are the same; use one of them", other->key, axis->key));
            }
        }
    }

    std::vector<Choice> choices_of(const GalleryItem& item, const GalleryPattern& pattern,
                                   const std::string& format) {
        if (pattern.is_piece) check_piece(item, pattern, format);
        check_sets(item, pattern);
        std::vector<Choice> choices;
        for (const GalleryItem::Axis& axis : item.axes) {
            if (!matters(*axis, keys_.interpreter_of(format))) continue;
            const GalleryKey* facts = axis->in_set ? nullptr : keys_.find(axis->key);
            const bool overrides = facts && facts->overrides;
            choices.push_back({axis,
                               axis->in_set ? axis->key
                               : overrides  ? override_key(axis->key, pattern)
                                            : "",
                               facts && (facts->kind == OptionKind::flag || facts->has_optional_value),
                               facts && facts->has_optional_value});
        }
        return choices;
    }

    void expand(const GalleryItem& item, const NameForm& form, const PatternShelf::Pointer& pattern,
                const std::string& format, std::vector<GalleryJob>& list) {
        const std::vector<Choice> choices = choices_of(item, *pattern, format);
        std::vector<std::uint64_t> at(choices.size(), 0);
        while (true) {
            watch();
            GalleryJob job = job_at(item, pattern, format, choices, at, choices.size());
            job.name = name_of(item, form, job, choices, at);
            check(item, job);
            // Checks values: all those of each axis, with the others at their first, and the ends of ranges.
            const auto others = std::count_if(at.begin(), at.end(), [](std::uint64_t value) { return value > 0; });
            if (others < 2) {
                std::size_t axis = 0;
                while (axis + 1 < choices.size() && at[axis] == 0) ++axis;
                if (choices.empty() || choices[axis].axis->is_end(at[axis])) check_pattern(item, job, choices, at);
            }
            list.push_back(std::move(job));
            // The last axis runs fastest.
            std::size_t axis = choices.size();
            while (axis > 0 && static_cast<double>(++at[axis - 1]) >= choices[axis - 1].axis->count()) at[--axis] = 0;
            if (axis == 0) return;
        }
    }

    /// Checks that the pattern compiles with the settings of the job; otherwise reports the first setting that breaks
    /// it, found by bisection. Errors of the pattern itself are left to its jobs.
    void check_pattern(const GalleryItem& item, const GalleryJob& job, const std::vector<Choice>& choices,
                       const std::vector<std::uint64_t>& at) {
        if (!job.pattern->text || job.pattern->is_piece) return;
        const auto problem_with = [&](std::size_t count) {
            return compilations_.of(job_at(item, job.pattern, job.format, choices, at, count)).problem;
        };
        if (compilations_.of(job).problem.empty() || !problem_with(0).empty()) return;
        std::size_t good = 0;
        std::size_t bad = choices.size();
        while (bad - good > 1) {
            const std::size_t middle = good + (bad - good) / 2;
            (problem_with(middle).empty() ? good : bad) = middle;
        }
        const std::string& place = choices[bad - 1].axis->place;
        fail(place.empty() ? job.place : place, problem_with(bad));
    }

    /// @param count  number of choices that are applied
    GalleryJob job_at(const GalleryItem& item, const PatternShelf::Pointer& pattern, const std::string& format,
                      const std::vector<Choice>& choices, const std::vector<std::uint64_t>& at,
                      std::size_t count) const {
        GalleryJob job;
        job.language = &keys_;
        job.documents = documents_;
        job.works = works_;
        job.format = format;
        job.pattern = pattern;
        job.place = item.place;
        job.folder = item.folder;
        for (std::size_t i = 0; i < count; ++i) {
            std::string value = choices[i].axis->value(at[i]);
            if (!choices[i].target.empty()) {
                job.overrides[choices[i].target] = std::move(value);
            } else if (value != "false" || !choices[i].is_flag) {
                if (choices[i].has_default && value == "true") value.clear();
                job.keys[choices[i].axis->key] = std::move(value);
            }
        }
        return job;
    }

    std::string name_of(const GalleryItem& item, const NameForm& form, const GalleryJob& job,
                        const std::vector<Choice>& choices, const std::vector<std::uint64_t>& at) {
        std::string name;
        if (!item.name) {
            name = name_part(job.pattern->name);
            if (job.keys.contains("variant")) name += "-" + name_part(job.keys.at("variant"));
            for (std::size_t i = 0; i < choices.size() && name.size() <= longest_job_name; ++i) {
                const GalleryAxis& axis = *choices[i].axis;
                if (axis.count() < 2 || axis.key == "variant") continue;
                name += fmt::format("-{}{}", name_part(axis.key), name_part(axis.value(at[i])));
            }
        } else {
            for (const NameForm::Piece& piece : form.pieces()) {
                if (name.size() > longest_job_name) break;
                name +=
                    piece.is_placeholder ? name_part(placeholder(item, job, choices, at, piece.text)) : piece.text;
            }
        }
        const std::string file = name + "." + job.format;
        const bool has_controls = std::any_of(name.begin(), name.end(),
                                              [](char letter) { return static_cast<unsigned char>(letter) < ' '; });
        const auto refuse = [&](const char* why) {
            fail(item.name_place.empty() ? item.place : item.name_place,
                 fmt::format("name: '{}' cannot be the name of an output{}", printable(name, 80), why));
        };
        // Records are JSON.
        if (!has_controls && !fits_xml(name)) refuse(": it is not valid UTF-8; 'name' sets another");
        // Parts of a path that are empty, hidden, or lead elsewhere.
        const std::string path = "/" + name + "/";
        if (name.empty() || path.find("//") != std::string::npos || path.find("/.") != std::string::npos ||
            is_summary(file) || is_record(name, file) || has_controls || file.size() > longest_job_name) {
            refuse("");
        }
        return name;
    }

    std::string placeholder(const GalleryItem& item, const GalleryJob& job, const std::vector<Choice>& choices,
                            const std::vector<std::uint64_t>& at, const std::string& written) {
        if (written == "pattern") return job.pattern->name;
        if (written == "kind") return job.pattern->kind;
        if (written == "format") return job.format;
        const std::string key = folded_key(written);
        for (std::size_t i = 0; i < choices.size(); ++i) {
            const GalleryAxis& axis = *choices[i].axis;
            if (axis.key == key || axis.key == written) return axis.value(at[i]);
        }
        // Use the pattern's value with the changes of the job; if there is none, the job itself reports why.
        if (key == "n") return job.pattern->text && !job.pattern->is_piece ? compilations_.of(job).steps : "";
        for (const GalleryItem::Axis& axis : item.axes) {
            if (axis->key == key || axis->key == written) return axis->value(0);
        }
        if (keys_.find(key)) return "";
        std::vector<std::string_view> known = {"pattern", "kind", "format", "n"};
        for (const GalleryItem::Axis& axis : item.axes) known.push_back(axis->key);
        const std::string_view near = nearest(written, known);
        known.resize(std::min<std::size_t>(known.size(), 50));
        fail(item.name_place, fmt::format("name: unknown placeholder {{{}}}{}", printable(written, 80),
                                          near.empty() ? fmt::format("; expected {}", fmt::join(known, ", "))
                                                       : fmt::format("; did you mean {{{}}}?", near)));
    }

    static void check(const GalleryItem& item, const GalleryJob& job) {
        if (job.keys.contains("tile") && job.format != "pdf") {
            const auto axis = std::find_if(item.axes.begin(), item.axes.end(),
                                           [](const GalleryItem::Axis& each) { return each->key == "tile"; });
            const std::string& place = axis == item.axes.end() ? job.place : (*axis)->place;
            fail(place.empty() ? job.place : place,
                 fmt::format(
                     "tile: sheets as {} are several files, and each job of a gallery makes one; a pdf has all "
                     "sheets as pages",
                     job.format));
        }
        try {
            job.interpreter().check(job.format, job.values());
        } catch (const SettingError& error) {
            const std::string message = error.what();
            // An error about a single option has the place of that option in the file.
            for (const GalleryItem::Axis& axis : item.axes) {
                if (axis->key == error.option() && !axis->place.empty()) fail(axis->place, message);
            }
            fail(job.place, message);
        }
    }

    std::vector<GalleryItem> items_;
    const GalleryKeys& keys_;
    Monitor monitor_;
    PatternShelf shelf_;
    PatternShelf::List all_;
    std::map<std::pair<std::shared_ptr<const std::vector<std::string>>, std::filesystem::path>, PatternShelf::List>
        found_;
    std::shared_ptr<Documents> documents_ = std::make_shared<Documents>();
    std::shared_ptr<Works> works_ = std::make_shared<Works>();
    Compilations compilations_;
    std::map<const GalleryPattern*, bool> defines_angle_;
    std::vector<PatternShelf::List> patterns_;
    mutable std::size_t watched_ = 0;
};

/// The kinds of the patterns, `Kolams, curves`, if they are few.
std::string title_of(const std::vector<GalleryJob>& jobs) {
    std::vector<std::string> kinds;
    for (const GalleryJob& job : jobs) {
        const std::string& kind = job.pattern->kind;
        if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
        if (kinds.size() > 3) return "Sikku";
    }
    std::string title = fmt::format("{}", fmt::join(kinds, ", "));
    if (title.empty()) return "Sikku";
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    return title;
}

/// Applies the command line, which takes precedence over files.
void take_request(const GalleryRequest& request, const GalleryKeys& keys, std::vector<GalleryItem>& items) {
    GalleryItem asked;
    for (const auto& [key, text] : request.keys) {
        GalleryValue value;
        value.text = text;
        if (key == "format" || key == "name") {
            read_gallery_key(keys, key, value, asked);
        } else {
            asked.take(std::make_shared<const GalleryAxis>(axis_of(key, value, keys.find(key))));
        }
    }
    for (const std::string& text : request.overrides) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw SettingError("set", text, "expected KEY=VALUE");
        }
        GalleryValue value;
        value.text = text.substr(equals + 1);
        asked.take(std::make_shared<const GalleryAxis>(axis_of(text.substr(0, equals), value, nullptr)));
    }
    const auto sets_scale = [&](const std::string& name) {
        const GalleryKey* key = keys.find(name);
        return key && key->sets_scale;
    };
    const bool is_scaled =
        std::any_of(request.keys.begin(), request.keys.end(), [&](const auto& key) { return sets_scale(key.first); });
    const auto sets_scale_otherwise = [&](const GalleryItem::Axis& axis) {
        return !axis->in_set && sets_scale(axis->key) && !request.keys.contains(axis->key);
    };
    for (GalleryItem& item : items) {
        if (is_scaled) std::erase_if(item.axes, sets_scale_otherwise);
        if (!asked.formats.empty()) item.formats = asked.formats;
        if (asked.name) {
            item.name = asked.name;
            item.name_place = asked.name_place;
        }
        for (const GalleryItem::Axis& axis : asked.axes) item.take(axis);
    }
}

/// A file that is read in blocks. @throws GalleryError if it cannot be opened
std::ifstream open_text_file(const std::string& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw GalleryError(fmt::format("{} is a folder", file));
    std::ifstream stream(file, std::ios::binary);
    if (!stream.is_open()) throw GalleryError(fmt::format("{}: {}", file, std::generic_category().message(errno)));
    return stream;
}

std::string read_gallery_text(const GalleryRequest& request) {
    if (request.gallery_text) return *request.gallery_text;
    if (std::error_code error; !std::filesystem::exists(request.gallery_file, error)) {
        const auto bundled = PatternLibrary::bundled().gallery_files();
        throw NotFound(
            fmt::format("no file or bundled gallery file named '{}'; {}", printable(request.gallery_file, 200),
                        bundled.empty() ? missing_patterns() : fmt::format("there are {}", fmt::join(bundled, ", "))),
            true);
    }
    std::ifstream stream = open_text_file(request.gallery_file);
    std::string text;
    for (std::array<char, 65536> block{}; stream && text.size() <= most_toml_bytes;) {
        stream.read(block.data(), block.size());
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) {
        throw GalleryError(fmt::format("{}: {}", request.gallery_file, std::generic_category().message(errno)));
    }
    return text;
}

void read_manifest_of(const GalleryRequest& request, const GalleryKeys& keys, const GalleryItem& defaults,
                      GalleryItems& items) {
    if (request.manifest_text) {
        std::istringstream stream(*request.manifest_text);
        return read_manifest(request, keys, stream, defaults, items);
    }
    std::ifstream stream = open_text_file(request.manifest);
    read_manifest(request, keys, stream, defaults, items);
    if (stream.bad())
        throw GalleryError(fmt::format("{}: {}", request.manifest, std::generic_category().message(errno)));
}

/// True for texts with keys that may name a file. Compiling them instead would take long for every job of a finished
/// gallery.
bool may_name_file(const std::string& text) {
    const std::string whole = lower_case(text);
    return std::any_of(language_keys().begin(), language_keys().end(), [&](const KeyInfo& key) {
        // Scales are common, and most have names.
        const std::string_view sign = key.name == "scale" ? ".scl" : key.name;
        return key.names_file && whole.find(sign) != std::string::npos;
    });
}

}  // namespace

std::string GalleryJob::text() const {
    nlohmann::json json;
    json["name"] = name;
    json["format"] = format;
    json["pattern"] = pattern->shown;
    for (const auto& [key, value] : keys) json[key] = value;
    for (const auto& [key, value] : overrides) json["set"][key] = value;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string GalleryJob::hash() const {
    TextHash hash;
    hash.add_piece(SIKKU_VERSION);
    hash.add_piece(format);
    hash.add_piece(pattern->text ? pattern->text->text : "");
    for (const auto& [key, value] : keys) {
        if (key == "budget") continue;  // it decides whether there is a file, not its contents
        hash.add_piece(key);
        hash.add_piece(value);
    }
    hash.add_piece("");
    for (const auto& [key, value] : overrides) {
        hash.add_piece(key);
        hash.add_piece(value);
    }
    // The contents of the files may change.
    for (const OptionValue& value : values()) {
        const OptionInfo& info = *find_option(interpreter().options(), value.name);
        if (info.is_key || !info.names_file || !info.names_file(value.text)) continue;
        hash.add_piece(works->digits_of(folder / value.text));
    }
    if (!pattern->text || !may_name_file(text() + pattern->text->text)) return hash.digits();
    try {
        for (const auto& [file, held] : work()->read_files()) {
            hash.add_piece(file);
            hash.add_piece(held);
        }
    } catch (const std::exception&) {
        // The job itself reports why.
    }
    return hash.digits();
}

OptionValues GalleryJob::values() const {
    OptionValues values;
    for (const OptionInfo* info : interpreter().options()) {
        const auto found = keys.find((info->is_on ? "no-" : "") + std::string(info->name));
        if (found == keys.end()) continue;
        values.push_back({std::string(info->name), info->is_on ? "false" : found->second});
    }
    return values;
}

std::vector<Setting> GalleryJob::key_settings() const {
    std::vector<Setting> settings;
    for (const OptionValue& value : values()) {
        const OptionInfo& info = *find_option(interpreter().options(), value.name);
        if (!info.is_key || info.sets_more || (info.names_file && info.names_file(value.text))) continue;
        std::string key = value.name;
        std::replace(key.begin(), key.end(), '-', ' ');
        settings.push_back({value.name, std::move(key), value.text});
    }
    return settings;
}

Document GalleryJob::document() const {
    if (!pattern->text) throw std::runtime_error(pattern->problem);
    if (pattern->piece) return pattern->piece->documents.front();
    Overrides settings;
    for (const auto& [key, value] : overrides) settings.settings.push_back(Setting::assignment("set", key, value));
    if (keys.contains("n")) settings.settings.push_back({"n", "derivation length", keys.at("n")});
    if (keys.contains("seed")) settings.settings.push_back({"seed", "seed", keys.at("seed")});
    if (keys.contains("variant")) settings.variant = keys.at("variant");
    std::string key = fmt::format("{}", static_cast<const void*>(pattern.get()));
    const auto add = [&key](const std::string& piece) { key += fmt::format(":{}:{}", piece.size(), piece); };
    add(settings.variant);
    for (const Setting& setting : settings.settings) {
        add(setting.key);
        add(setting.value);
    }
    return documents->get(key, pattern->text->text.size(), [&] {
        Diagnostics diagnostics;
        Document document =
            compile(pattern->text->name, pattern->text->text, settings, language->interpreters(), diagnostics);
        diagnostics.throw_if_errors();
        return document;
    });
}

std::shared_ptr<Work> GalleryJob::work() const {
    const std::size_t bytes = pattern->text ? pattern->text->text.size() : 0;
    return works->get(file(), bytes, [&] {
        return pattern->piece ? pattern->piece->plan(format, values(), folder)
                              : interpreter().plan(document(), format, values(), folder);
    });
}

std::vector<GalleryJob> gallery_jobs(GalleryRequest& request, const GalleryKeys& keys) {
    GalleryItem defaults;
    GalleryItems items;
    if (!request.poster.empty()) check_sheet_size("poster", request.poster, "");
    if (!request.contact.empty()) check_sheet_size("contact", request.contact, "");
    if (!request.gallery_file.empty()) {
        defaults.folder = std::filesystem::path(request.gallery_file).parent_path();
        defaults.place = request.gallery_file + ":1:1";
        read_gallery(keys, request.gallery_file, read_gallery_text(request), defaults, request, items);
    }
    if (!request.manifest.empty()) read_manifest_of(request, keys, defaults, items);
    if (!request.patterns.empty()) {
        // Relative to the current folder, not to the gallery file.
        GalleryItem item = defaults;
        item.folder.clear();
        item.place.clear();
        item.patterns_place.clear();
        item.patterns = std::make_shared<const std::vector<std::string>>(request.patterns);
        items.add(std::move(item));
    } else if (items.list.empty() && request.manifest.empty()) {
        items.add(defaults);
    }
    take_request(request, keys, items.list);
    Expansion expansion(std::move(items.list), request, keys);
    expansion.require_few(request.most_jobs);
    std::vector<GalleryJob> jobs = expansion.jobs();
    const auto is_print = [](const GalleryJob& job) { return job.interpreter().owner() == KeyOwner::art; };
    if (!std::any_of(jobs.begin(), jobs.end(), is_print)) {
        for (const auto& [option, size] :
             {std::pair("poster", request.poster), std::pair("contact", request.contact)}) {
            if (!size.empty()) throw SettingError(option, size, "this gallery has no prints for a sheet");
        }
    }
    if (request.title.empty()) request.title = title_of(jobs);
    return jobs;
}

}  // namespace sikku
