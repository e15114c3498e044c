#include "art/gallery/summary.h"

#include "art/gallery/page.h"
#include "art/gallery/values.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "art/product/print_cell.h"
#include "art/sheet/sheet.h"
#include "art/style/white_paper.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

namespace sikku {
namespace {

constexpr std::array<std::string_view, 2> sheet_names = {"poster", "contact"};
constexpr std::array<std::string_view, 3> sheet_formats = {"pdf", "png", "svg"};

bool is_print(const GalleryJob& job) {
    return &job.interpreter() == &prints();
}

/// Jobs of one name, in the order of their first.
struct NamedJobs {
    std::vector<const GalleryJob*> jobs;
    /// @param format extension of the format; jobs may use its alias
    const GalleryJob* find(std::string_view format) const {
        for (const GalleryJob* job : jobs) {
            if (find_format(job->interpreter().formats(), job->format)->extension == format) return job;
        }
        return nullptr;
    }
};

std::vector<NamedJobs> by_name(const std::vector<const GalleryJob*>& jobs) {
    std::vector<NamedJobs> list;
    std::map<std::string_view, std::size_t> places;
    for (const GalleryJob* job : jobs) {
        const auto [place, is_new] = places.emplace(job->name, list.size());
        if (is_new) list.emplace_back();
        list[place->second].jobs.push_back(job);
    }
    return list;
}

/// The settings of a job in one line: `angle increment = 60, size = A4`.
/// @param keys  options to list, below a caption that states the angle; null: all except the derivation length
std::string settings_of(const GalleryJob& job, const std::set<std::string>* keys) {
    std::string text;
    const auto add = [&](const std::string& key, const std::string& value) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, value);
    };
    for (const auto& [key, value] : job.overrides) {
        if (!keys || (key != "angle increment" && key != "angle factor")) add(key, value);
    }
    for (const auto& [key, value] : job.keys) {
        if (key == "n" || key == "budget" || (keys && !keys->contains(key))) continue;
        add(key, value);
    }
    return text;
}

/// The growth of the word: exponential, polynomial or bounded in the number of steps; empty if the grammar does not
/// determine it.
std::string growth_of(const Grammar& grammar) {
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const auto longer = grammar.with_steps(std::int64_t{40} << i);
        const auto known = longer ? estimate(*longer, false) : std::nullopt;
        if (!known || !std::isfinite(known->log10_length)) return {};
        lengths[i] = known->log10_length;
    }
    const double first = lengths[1] - lengths[0];
    const double second = lengths[2] - lengths[1];
    if (second < 1e-9) return "bounded";
    // Doubling the steps adds the same again to the logarithm of a power, and twice as much to that of an
    // exponential.
    return second > 1.5 * first ? "exponential" : "polynomial";
}

std::string angle_of(const Pattern& pattern) {
    std::string increment = pattern.text("angle increment");
    if (!increment.empty()) return increment;
    const std::string factor = pattern.text("angle factor");
    int parts = 0;
    const auto [end, error] = std::from_chars(factor.data(), factor.data() + factor.size(), parts);
    if (error != std::errc() || end != factor.data() + factor.size() || parts <= 0) return {};
    return fmt::format("{:.6g}", 360.0 / parts);
}

GalleryEntry entry_of(const NamedJobs& item) {
    const GalleryJob& first = *item.jobs.front();
    const Document loaded = first.document();
    GalleryEntry entry;
    entry.name = first.name;
    const auto& piece = first.pattern->piece;
    entry.title = piece ? piece->title : loaded.pattern().text("title");
    if (entry.title.empty()) entry.title = first.pattern->name;
    entry.source = piece ? piece->source : loaded.pattern().text("source");
    if (!piece) entry.description = loaded.pattern().text("description");
    entry.kind = first.pattern->kind;
    if (!piece) {
        entry.n = std::to_string(loaded.grammar().steps());
        entry.angle = angle_of(loaded.pattern());
        entry.growth = growth_of(loaded.grammar());
    }
    entry.settings = settings_of(first, nullptr);
    entry.pattern = first.pattern->text ? first.pattern->text->text : std::string();
    // Formats that browsers show come first; a picture is the quickest thumbnail.
    const GalleryJob* shown = nullptr;
    for (const std::string_view format : {"svg", "png", "jpg", "notes.svg", "pdf", "tif", "exr"}) {
        if (!shown) shown = item.find(format);
    }
    if (!shown) shown = &first;
    entry.print = shown->file();
    for (const std::string_view format : {"png", "jpg", "svg", "notes.svg"}) {
        const GalleryJob* small = item.find(format);
        if (small && entry.thumbnail.empty()) entry.thumbnail = small->file();
    }
    if (is_print(*shown)) {
        const Page page = read_draw_settings(shown->values()).paper.page;
        entry.width = static_cast<int>(std::lround(page.width));
        entry.height = static_cast<int>(std::lround(page.height));
    }
    for (const GalleryJob* job : item.jobs) {
        if (job == shown) continue;
        entry.extras.emplace_back(job->language->label(job->format), job->file());
    }
    return entry;
}

}  // namespace

bool is_summary(std::string_view file) {
    if (file == "index.html") return true;
    for (const std::string_view name : sheet_names) {
        for (const std::string_view format : sheet_formats) {
            if (file == fmt::format("{}.{}", name, format)) return true;
        }
    }
    return false;
}

bool is_gallery_page(std::string_view beginning) {
    return beginning.find("<meta name=\"generator\" content=\"Sikku\"/>") != std::string_view::npos;
}

void write_gallery_index(const std::vector<const GalleryJob*>& jobs, const std::string& title,
                         const std::filesystem::path& path, Destination& destination, const Monitor& monitor) {
    std::vector<GalleryEntry> entries;
    for (const NamedJobs& item : by_name(jobs)) {
        monitor.check();
        entries.push_back(entry_of(item));
    }
    const std::unique_ptr<Output> file = destination.open(path);
    write_gallery_page(title, entries, *file);
    file->commit();
}

std::vector<std::string> sheet_files(const SheetRequest& request) {
    std::vector<std::string> files;
    files.reserve(sheet_formats.size());
    for (const std::string_view format : sheet_formats) files.push_back(fmt::format("{}.{}", request.name, format));
    return files;
}

namespace {

/// The prints among the jobs.
std::vector<SheetCell> cells_of(const std::vector<const GalleryJob*>& jobs, const SheetRequest& request,
                                const Monitor& monitor = {}) {
    std::vector<SheetCell> cells;
    std::map<const GalleryPattern*, std::set<std::int64_t>> lengths;
    // Settings that distinguish the prints of a pattern.
    std::map<const GalleryPattern*, const GalleryJob*> first;
    std::map<const GalleryPattern*, std::set<std::string>> varying;
    std::vector<std::pair<const GalleryJob*, Document>> prints;
    for (const NamedJobs& item : by_name(jobs)) {
        const auto print =
            std::find_if(item.jobs.begin(), item.jobs.end(), [](const GalleryJob* job) { return is_print(*job); });
        if (print == item.jobs.end()) continue;
        prints.emplace_back(*print, (*print)->document());
        lengths[(*print)->pattern.get()].insert(prints.back().second.grammar().steps());
        const GalleryJob& other = *first.emplace((*print)->pattern.get(), *print).first->second;
        std::set<std::string>& keys = varying[(*print)->pattern.get()];
        for (const auto& [one, two] : {std::pair(*print, &other), std::pair(&other, *print)}) {
            for (const auto& [key, value] : one->keys) {
                const auto found = two->keys.find(key);
                if (found == two->keys.end() || found->second != value) keys.insert(key);
            }
        }
    }
    const bool has_rows =
        std::all_of(lengths.begin(), lengths.end(), [](const auto& one) { return one.second.size() > 1; });
    const GalleryPattern* row = nullptr;
    for (auto& [job, loaded] : prints) {
        const DrawSettings settings = read_draw_settings(job->values());
        SheetCell cell = print_cell(loaded, settings, job->folder, nullptr, monitor);
        cell.dot_spacing.reset();                // the drawing is scaled to fill its cell
        if (cell.colouring) cell.colouring = 0;  // regions of any area
        if (cell.title.empty()) cell.title = job->pattern->name;
        if (has_rows) {
            cell.caption = {fmt::format("n = {}", cell.grammar->steps())};
            if (job->pattern.get() != row) cell.heading = cell.title;
            row = job->pattern.get();
        } else if (request.is_poster) {
            cell.caption = caption_of(*cell.grammar, cell.title, loaded.pattern());
        } else {
            cell.caption = {job->name};
        }
        if (request.is_poster) {
            const std::string told = settings_of(*job, &varying.at(job->pattern.get()));
            if (!told.empty()) cell.caption.push_back(told);
        }
        cells.push_back(std::move(cell));
    }
    return cells;
}

SheetOptions options_of(const SheetRequest& request, const std::filesystem::path& file) {
    SheetOptions options;
    options.format = *print_format(file);
    options.page = read_draw_settings({{"size", request.size}, {"margin", "0mm"}}).paper.page;
    options.page.margin = std::min(options.page.width, options.page.height) / 25;
    // Large sheets are viewed from farther away, and memory is limited.
    options.dpi = std::clamp(300.0 * 420 / std::max(options.page.width, 420.0), 100.0, 300.0);
    options.caption_lines = request.is_poster ? 5 : 1;
    options.made = fmt::format("sikku {}", SIKKU_VERSION);
    options.threads = request.threads;
    options.memory = request.memory;
    return options;
}

/// True if the prints are on white paper, which then continues between them.
bool is_white(const std::vector<const GalleryJob*>& jobs, const std::vector<SheetCell>& cells) {
    const auto has_paper = [](const GalleryJob* job) {
        const auto is_paper = [](const auto& setting) {
            return setting.first == "paper" && setting.second == "white";
        };
        return std::any_of(job->keys.begin(), job->keys.end(), is_paper) ||
               std::any_of(job->overrides.begin(), job->overrides.end(), is_paper);
    };
    return std::any_of(jobs.begin(), jobs.end(), has_paper) &&
           std::all_of(cells.begin(), cells.end(),
                       [](const SheetCell& cell) { return cell.style.ground == white_paper; });
}

}  // namespace

std::string draw_gallery_sheet(const std::vector<const GalleryJob*>& jobs, const SheetRequest& request,
                               const std::filesystem::path& file, Destination& destination, const Monitor& monitor) {
    const std::vector<SheetCell> cells = cells_of(jobs, request, monitor);
    if (cells.empty()) throw GalleryError("this gallery has no prints for a sheet");
    SheetOptions options = options_of(request, file);
    if (is_white(jobs, cells)) options.ground = white_paper;
    options.monitor = monitor;
    options.watch = [monitor](std::uint64_t) { monitor.check(); };
    return draw_sheet(cells, options, file, destination).letters_warning;
}

double gallery_sheet_memory(const std::vector<const GalleryJob*>& jobs, const SheetRequest& request,
                            const std::filesystem::path& file) {
    return sheet_memory(cells_of(jobs, request), options_of(request, file));
}

}  // namespace sikku
