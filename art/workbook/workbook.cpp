#include "art/workbook/workbook.h"

#include "art/analysis.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/motion/lesson.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "art/product/plot_remarks.h"
#include "art/product/print_cell.h"
#include "art/sheet/sheet_cells.h"
#include "art/sheet/sheet_maker.h"
#include "art/workbook/workbook_pages.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_kolams = 60;

struct WorkbookSettings {
    std::string heading = "Kolams from easy to hard";
    glm::dvec2 sheet{210, 297};
    bool is_booklet = false;
    bool keeps_order = false;
    std::string colouring = "200";
};

using W = WorkbookSettings;
using Text = const std::string&;
using enum OptionKind;

glm::dvec2 size_of(Text text) {
    constexpr double least = 100, most = 2000;
    const auto size = parse_size(text, 300);
    if (!size || !(std::min(size->x, size->y) >= least && std::max(size->x, size->y) <= most)) {
        refuse_option("size", text, "expected a sheet of 10 cm to 2 m, such as A4, A3 or letter");
    }
    return *size;
}

const std::array rows = {
    Option<W>{{.name = "heading", .help = "title of the front page (Kolams from easy to hard)", .value = "TEXT"},
              [](W& w, Text t) { w.heading = t; }},
    Option<W>{
        {.name = "booklet",
         .help = "two pages on each side of a sheet, in the order of a booklet: print on both sides, turned over "
                 "the short edge, fold and staple",
         .kind = flag},
        [](W& w, Text t) { w.is_booklet = t == "true"; }},
    Option<W>{{.name = "size", .help = "size of the sheets of paper (A4)", .value = "SIZE"},
              [](W& w, Text t) { w.sheet = size_of(t); }},
    Option<W>{
        {.name = "keep-order", .help = "keep the order of the arguments, instead of from easy to hard", .kind = flag},
        [](W& w, Text t) { w.keeps_order = t == "true"; }},
    Option<W>{{.name = "colouring",
               .help = "least area of the regions of colouring pages; kolams with smaller ones have none (200mm2)",
               .value = "AREA",
               .unit = "mm2",
               .kind = number,
               .least = 0,
               .most = 1e6},
              [](W& w, Text t) { w.colouring = t; }},
};

/// A planned workbook.
class WorkbookWork : public Work {
public:
    WorkbookWork(const std::vector<SheetItem>& items, const OptionValues& values, std::filesystem::path folder)
        : folder_(std::move(folder)) {
        apply_options(std::span<const Option<W>>(rows), values, settings_);
        if (items.empty()) throw SettingError("", "", "a workbook needs at least one kolam");
        if (items.size() > most_kolams) {
            throw SettingError("", "", fmt::format("a workbook has at most {} kolams", most_kolams));
        }
        page_ = page_options();
        for (const SheetItem& item : items) add_named(item);
    }

    Cost forecast() const override {
        constexpr double drawings = 18;  // on the pages of a kolam
        Cost cost;
        for (const Draft& draft : drafts_) {
            const Cost own = sheet_cost({draft.whole}, page_);
            cost.seconds += drawings * (own.seconds - own.shared_seconds);
            cost.bytes += drawings * own.bytes;
            cost.memory = std::max(cost.memory, own.memory);
        }
        return cost;
    }

    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override {
        page_.monitor = monitor;
        page_.threads = threads;
        const std::vector<WorkbookKolam> kolams = read_kolams();
        list_pages(kolams);
        SheetOptions document = page_;
        document.title = settings_.heading;
        document.made = fmt::format("sikku {}, workbook of {}", SIKKU_VERSION, counted(kolams.size(), "kolam"));
        document.page = {settings_.sheet.x, settings_.sheet.y, 0};
        if (settings_.is_booklet) document.page = {2 * page_.page.width, page_.page.height, 0};
        const std::vector<SheetPage> sides = arranged();
        monitor.expect(static_cast<double>(sides.size()));
        Made made;
        warn_of_letters(draw_pages(sides, document, name, destination), made);
        made.fact(fmt::format("{} of {}", counted(pages_.size(), "page"), counted(kolams.size(), "kolam")));
        if (settings_.is_booklet) made.fact(fmt::format("{} to fold", counted(sides.size() / 2, "sheet")));
        for (const std::string& text : without_colouring_) made.warn(text);
        return made;
    }

private:
    /// A kolam before it was examined.
    struct Draft {
        Document document;
        DrawSettings settings;
        SheetCell whole;
    };

    /// Options of a page; a booklet has two on each side of a sheet.
    SheetOptions page_options() const {
        constexpr double margin_share = 0.06;
        SheetOptions options;
        glm::dvec2 size = settings_.sheet;
        if (settings_.is_booklet) size = {std::max(size.x, size.y) / 2, std::min(size.x, size.y)};
        options.page = {size.x, size.y, margin_share * std::min(size.x, size.y)};
        options.format = PrintFormat::pdf;
        options.ground.reset();
        options.is_centred = true;
        options.inset = 0.03;
        return options;
    }

    /// Errors name the kolam.
    void add_named(const SheetItem& item) {
        try {
            drafts_.push_back(draft_of(item));
        } catch (const SettingError& error) {
            const std::string name = std::filesystem::path(item.document.source().name()).filename().string();
            throw SettingError(error.option(), error.value(), fmt::format("{} ('{}')", error.message(), name));
        }
    }

    static std::string title_of(const SheetItem& item, const std::string& title) {
        const auto given = std::find_if(item.values.begin(), item.values.end(),
                                        [](const OptionValue& value) { return value.name == "title"; });
        if (given != item.values.end()) return given->text;
        return title.empty() ? std::filesystem::path(item.document.source().name()).stem().string() : title;
    }

    Draft draft_of(const SheetItem& item) const {
        OptionValues own = item.values;
        std::erase_if(own, [](const OptionValue& value) { return value.name == "title"; });
        for (const OptionValue& value : own) refuse_alone(value);
        own.push_back({"paper", "white"});
        const Assignment assigned = assign(prints(), item.document, own);
        require_turtle(assigned.document, "it has no strokes to teach");
        Draft draft{assigned.document, read_draw_settings(assigned.options), {}};
        check_draw_settings(draft.settings, PrintFormat::pdf);
        if (!draft.settings.keys.empty()) draft.document = draft.document.with(draft.settings.keys);
        DrawSettings with_dots = draft.settings;
        with_dots.time.lesson = 0;
        draft.whole = print_cell(draft.document, with_dots, folder_);
        draft.whole.title = title_of(item, draft.document.text("title"));
        return draft;
    }

    /// Examines the kolams, and sorts them.
    std::vector<WorkbookKolam> read_kolams() {
        std::vector<WorkbookKolam> kolams;
        without_colouring_.clear();
        for (const Draft& draft : drafts_) {
            named_cell(draft.whole, [&] {
                WorkbookKolam& kolam = kolams.emplace_back();
                kolam.whole = draft.whole;
                kolam.facts = facts_of(draft);
                kolam.colouring = colouring_of(draft);
            });
        }
        if (settings_.keeps_order) return kolams;
        std::stable_sort(kolams.begin(), kolams.end(), [](const WorkbookKolam& a, const WorkbookKolam& b) {
            return a.facts.difficulty() < b.facts.difficulty();
        });
        return kolams;
    }

    static void refuse_alone(const OptionValue& value) {
        const OptionInfo* option = find_option(prints().options(), value.name);
        if (!option) return;
        const bool is_drawing = option->scope == Scope::look || option->scope == Scope::turn || option->is_key;
        if (!is_drawing) refuse_option(value.name, value.text, "the pages of a workbook have their own");
    }

    KolamFacts facts_of(const Draft& draft) const {
        const double budget = draft.settings.work.budget;
        const KolamExamination found = examine_kolam(draft.document, budget, page_.monitor);
        const glm::dmat3x2 turned = orientation(draft.whole.placement);
        const auto on_page = [&](glm::dvec2 at) { return turned * glm::dvec3(at, 1); };
        std::vector<glm::dvec2> dots;
        for (const glm::dvec2 dot : dot_places(found)) dots.push_back(on_page(dot));
        const DotRows dot_rows(std::move(dots));
        Print print;
        print.style = draft.whole.style;
        DrawOptions options;
        static_cast<DrawingOptions&>(options) = draft.whole;
        options.budget = budget;
        options.monitor = page_.monitor;
        const LessonLength lesson = lesson_length(draft.document.grammar(), print, options);
        KolamFacts facts{.title = draft.whole.title,
                         .grid = grid_of(draft, found, dot_rows),
                         .dots = dot_rows.count(),
                         .lines = found.lines,
                         .crossings = found.crossings,
                         .open_lines = found.open_lines,
                         .strokes = lesson.starts.size(),
                         .symmetry = found.symmetry,
                         .starts = {}};
        for (const glm::dvec2 start : lesson.starts) facts.starts.push_back(dot_rows.nearest(on_page(start)));
        return facts;
    }

    /// The notation of the pattern if it is short, else that of its dots; empty for radial kolams.
    static std::string grid_of(const Draft& draft, const KolamExamination& found, const DotRows& dots) {
        constexpr std::size_t longest = 20;
        if (found.dots_on_lines() > 0) return "";
        const std::string stated(kolam_comment(draft.document.source().text(), "grid"));
        const bool is_shape = stated.find('/') != std::string::npos || stated.starts_with('@');
        return stated.empty() || is_shape || stated.size() > longest ? dots.notation() : stated;
    }

    /// The drawing of the colouring page, if its regions are large enough.
    std::optional<SheetCell> colouring_of(const Draft& draft) {
        DrawSettings settings = draft.settings;
        settings.look.colouring = to_number(settings_.colouring);
        const std::vector<SheetCell> cells = {print_cell(draft.document, settings, folder_)};
        SheetOptions page = page_;
        page.title = page.subtitle = draft.whole.title;
        try {
            SheetMaker(cells, page).arrange();
            return cells.front();
        } catch (const SettingError& error) {
            if (error.option() != "colouring") throw;
            without_colouring_.push_back(
                fmt::format("'{}' has no colouring page: {}", draft.whole.title, error.message()));
            return std::nullopt;
        }
    }

    /// Numbers the pages, after the front page.
    void list_pages(const std::vector<WorkbookKolam>& kolams) {
        std::vector<std::size_t> first_pages;
        std::vector<PlacedSheet> inside;
        pages_.clear();
        for (const WorkbookKolam& kolam : kolams) {
            first_pages.push_back(inside.size() + 2);
            for (PlacedSheet& sheet : pages_of(kolam, page_)) {
                sheet.options.footer = std::to_string(inside.size() + 2);
                inside.push_back(std::move(sheet));
            }
        }
        pages_.push_back(front_page(kolams, first_pages, settings_.heading, page_));
        for (PlacedSheet& sheet : inside) pages_.push_back(std::move(sheet));
    }

    /// The pages on the sides of the sheets of paper, in the order of printing.
    std::vector<SheetPage> arranged() const {
        std::vector<SheetPage> sides;
        if (!settings_.is_booklet) {
            for (const PlacedSheet& sheet : pages_) sides.push_back({sheet});
            if (sides.size() % 2 == 1) sides.emplace_back();
            return sides;
        }
        const std::size_t count = (pages_.size() + 3) / 4 * 4;
        const auto add = [&](SheetPage& side, std::size_t page, double left) {
            if (page >= pages_.size()) return;
            side.push_back(pages_[page]);
            side.back().at = {left, 0};
        };
        for (const auto& [left, right] : saddle_stitch(count)) {
            SheetPage& side = sides.emplace_back();
            add(side, left, 0);
            add(side, right, page_.page.width);
        }
        return sides;
    }

    std::filesystem::path folder_;
    WorkbookSettings settings_;
    SheetOptions page_;
    std::vector<Draft> drafts_;
    std::vector<PlacedSheet> pages_;
    std::vector<std::string> without_colouring_;
};

}  // namespace

std::span<const OptionInfo* const> workbook_options() {
    static const std::vector<const OptionInfo*> table = [] {
        std::vector<const OptionInfo*> list;
        for (const Option<W>& row : rows) list.push_back(&row.info);
        return list;
    }();
    return table;
}

std::unique_ptr<Work> plan_workbook(const std::vector<SheetItem>& items, const OptionValues& values,
                                    const std::filesystem::path& folder) {
    return std::make_unique<WorkbookWork>(items, values, folder);
}

}  // namespace sikku
