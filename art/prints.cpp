#include "art/prints.h"

#include "art/deep/window_drawing.h"
#include "art/product/draw_settings.h"
#include "art/product/print_kinds.h"
#include "art/product/print_work.h"
#include "art/product/unused_options.h"
#include "art/raster/raster.h"
#include "art/writer/draw.h"
#include "art/writer/swatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

/// Sets the window of the settings to a place of a tiling that covers the page. Returns the document with the
/// derivation length that it takes. @throws SettingError if there is none
Document fill_page(const Document& document, DrawSettings& settings) {
    constexpr double steps_across = 40;
    const Page& page = settings.paper.page;
    const double step = settings.look.placement.step.value_or(std::min(page.width, page.height) / steps_across);
    const Document styled = settings.keys.empty() ? document : document.with(settings.keys);
    if (styled.grammar().is_spatial() || styled.grammar().map()) {
        refuse_option("fill-page", "", "applies only to tilings in the plane");
    }
    ReadingLimits limits;
    limits.budget = settings.work.budget;
    std::string why;
    const glm::dvec2 size = (glm::dvec2(page.width, page.height) - 2 * page.margin) / step;
    const double around = (page.margin + settings.paper.press.bleed) / step;
    const auto found =
        find_filled_page(styled.grammar(), read_print_style(document, settings), size, around, limits, why);
    if (!found) refuse_option("fill-page", "", why);
    settings.look.placement.step.reset();
    settings.look.window = found->window;
    return document.with({Setting{"fill-page", "derivation length", std::to_string(found->steps)}});
}

/// Sets the page and the place of the settings to the repeating part of a tiling. Returns the document with the
/// derivation length it needs. @throws SettingError if there is none
Document take_swatch(const Document& document, DrawSettings& settings, PrintFormat format) {
    constexpr double steps_across = 40, most_millimetres = 10'000;
    Page& page = settings.paper.page;
    const double step = settings.look.placement.step.value_or(std::min(page.width, page.height) / steps_across);
    const Document styled = settings.keys.empty() ? document : document.with(settings.keys);
    ReadingLimits limits;
    limits.budget = settings.work.budget;
    try {
        settings.place.swatch_place =
            find_swatch(styled.grammar(), read_print_style(styled, settings), drawing_options(settings, document),
                        limits, settings.place.swatch == SwatchChoice::turned);
    } catch (const SwatchError& error) {
        refuse_option("swatch", "", error.what());
    }
    const Swatch& swatch = *settings.place.swatch_place;
    const glm::dvec2 size = (swatch.frame.high - swatch.frame.low) * step;
    if (!(std::max(size.x, size.y) <= most_millimetres)) {
        refuse_option("swatch", "",
                      fmt::format("the part that repeats would be {:.3g} x {:.3g} m", size.x / 1000, size.y / 1000));
    }
    settings.look.placement.step = step;
    page = {size.x, size.y, 0};
    if (!is_vector(format) && info(format).kind != FormatKind::model) {
        const PixelSize pixels = pixel_size(page, settings.paper.dpi);
        page = {pixels.width * 25.4 / settings.paper.dpi, pixels.height * 25.4 / settings.paper.dpi, 0};
        settings.place.swatch_stretch = glm::dvec2(page.width, page.height) / size;
    }
    check_draw_settings(settings, format);
    return document.with({Setting{"swatch", "derivation length", std::to_string(swatch.steps)}});
}

/// Unless `values` names a resolution, the longer side of a .gif has 640 pixels: at 300 dpi, an animation of A4 would
/// take ten minutes.
OptionValues with_resolution(const OptionValues& values, PrintFormat format) {
    const auto is_dpi = [](const OptionValue& value) { return value.name == "dpi"; };
    if (format != PrintFormat::gif || std::any_of(values.begin(), values.end(), is_dpi)) return values;
    const Page page = read_draw_settings(values).paper.page;
    const double dpi = 640 * 25.4 / std::max(page.width, page.height);
    OptionValues result = values;
    result.push_back({"dpi", fmt::format("{}", std::clamp(dpi, 1.0, 300.0))});
    return result;
}

/// A product, and the prints that it is. The first of the table that holds is made.
struct Product {
    PrintKind is_made;
    std::unique_ptr<PrintWork> (*plan)(PrintRequest request);
};
constexpr Product products[] = {
    {when::model, plan_model},   {when::rule, plan_rule}, {when::division, plan_division}, {when::grown, plan_growth},
    {when::lesson, plan_lesson}, {when::row, plan_row},   {when::always, plan_one},
};

/// @throws SettingError, PatternError
std::unique_ptr<PrintWork> plan_print(const Document& document, PrintFormat format, const OptionValues& values,
                                      const std::filesystem::path& folder = {}) {
    DrawSettings settings = read_draw_settings(with_resolution(values, format), &folder);
    if (!settings.paper.press.cmyk.empty()) settings.paper.press.cmyk = folder / settings.paper.press.cmyk;
    check_draw_settings(settings, format);
    const Document longer = settings.place.swatch != SwatchChoice::none ? take_swatch(document, settings, format)
                            : settings.place.fills_page                 ? fill_page(document, settings)
                                                                        : document;
    const auto product = std::find_if(std::begin(products), std::end(products),
                                      [&](const Product& one) { return one.is_made(settings, format); });
    GivenOptions given = given_options(values, settings.keys, document.source().text());
    return product->plan({longer, format, std::move(settings), std::move(given), folder});
}

class Prints : public Interpreter {
public:
    Prints() {
        for (const FormatInfo& row : print_formats()) {
            // An OBJ has its materials beside it.
            const bool is_several = row.kind == FormatKind::animation || row.format == PrintFormat::obj;
            formats_.push_back({row.extension, row.label, row.alias, is_several, row.is_text});
        }
        for (const Option<DrawSettings>& row : draw_options()) options_.push_back(&row.info);
    }
    KeyOwner owner() const override { return KeyOwner::art; }
    void check_keys(const Pattern& pattern, Diagnostics& diagnostics) const override {
        read_style(pattern, 96, diagnostics);  // errors do not depend on the resolution
    }
    std::span<const FormatName> formats() const override { return formats_; }
    std::span<const OptionInfo* const> options() const override { return options_; }
    void check(std::string_view format, const OptionValues& values) const override {
        const PrintFormat named = known(format);
        check_draw_settings(read_draw_settings(with_resolution(values, named)), named);
    }
    std::unique_ptr<Work> plan(const Document& document, std::string_view format, const OptionValues& values,
                               const std::filesystem::path& folder) const override {
        return plan_print(document, known(format), values, folder);
    }

private:
    static PrintFormat known(std::string_view format) {
        if (const auto found = named_format(format)) return *found;
        refuse_option("format", std::string(format), "unknown format");
    }
    std::vector<FormatName> formats_;
    std::vector<const OptionInfo*> options_;
};

}  // namespace

const Interpreter& prints() {
    static const Prints interpreter;
    return interpreter;
}

std::string draw(const Document& document, std::string_view format, const OptionValues& values,
                 const Monitor& monitor) {
    return make_in_memory(prints(), document, format, values, monitor);
}

DrawnPixels draw_pixels(const Document& document, const OptionValues& values, const Monitor& monitor) {
    constexpr std::size_t bytes_of_pixel = 4;
    const Assignment assigned = assign(prints(), document, values);
    const auto work = plan_print(assigned.document, PrintFormat::png, assigned.options);
    DrawnPixels pixels;
    work->pass_pixels([&](Rendering& rendering, const PixelSize& size) {
        pixels.width = size.width;
        pixels.height = size.height;
        pixels.bytes.resize(bytes_of_pixel * static_cast<std::size_t>(size.width) *
                            static_cast<std::size_t>(size.height));
        const auto channels = static_cast<std::size_t>(rendering.channels());
        std::uint8_t* to = pixels.bytes.data();
        rendering.watch([&] { monitor.check(); });
        rendering.render(work->threads(), [&](int, int, std::span<const std::uint8_t> rows) {
            for (std::size_t i = 0; i < rows.size(); i += channels, to += bytes_of_pixel) {
                const std::uint8_t* from = &rows[i];
                to[0] = from[0];
                to[1] = from[channels < 3 ? 0 : 1];
                to[2] = from[channels < 3 ? 0 : 2];
                to[3] = channels == bytes_of_pixel ? from[3] : 255;
            }
        });
    });
    MemoryDestination nowhere;
    pixels.remarks = work->make(nowhere, "pixels", monitor, work->threads()).remarks;
    return pixels;
}

}  // namespace sikku
