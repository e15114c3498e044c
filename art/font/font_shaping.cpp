// art/font/font_shaping.cpp: reads fonts and shapes lines of text with HarfBuzz, in units of the font.
#include "art/font/font_module.h"
#include "art/font/text_runs.h"

#include <hb-ot.h>
#include <hb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

template <class Object, void (*destroy)(Object*)>
struct Destroys {
    void operator()(Object* object) const { destroy(object); }
};
using Blob = std::unique_ptr<hb_blob_t, Destroys<hb_blob_t, hb_blob_destroy>>;
using Face = std::unique_ptr<hb_face_t, Destroys<hb_face_t, hb_face_destroy>>;
using Typeface = std::unique_ptr<hb_font_t, Destroys<hb_font_t, hb_font_destroy>>;
using Buffer = std::unique_ptr<hb_buffer_t, Destroys<hb_buffer_t, hb_buffer_destroy>>;
using DrawFunctions = std::unique_ptr<hb_draw_funcs_t, Destroys<hb_draw_funcs_t, hb_draw_funcs_destroy>>;

[[noreturn]] void refuse_damaged() {
    throw std::runtime_error("the font is damaged");
}

/// A big-endian number; 0 beyond the end.
std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
    std::size_t number = 0;
    for (std::size_t i = at; i < at + count; ++i) {
        number = number << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    }
    return number;
}

/// Refuses fonts that end within a table, which HarfBuzz would read as blank.
/// Source: OpenType 1.9, table directory and font collections.
void require_whole(std::string_view bytes, std::size_t index) {
    const std::size_t head = bytes.starts_with("ttcf") ? number_at(bytes, 12 + 4 * index, 4) : 0;
    const std::size_t tables = number_at(bytes, head + 4, 2);
    for (std::size_t record = head + 12; record < head + 12 + 16 * tables; record += 16) {
        const std::size_t end = number_at(bytes, record + 8, 4) + number_at(bytes, record + 12, 4);
        if (record + 16 > bytes.size() || end > bytes.size()) {
            throw std::runtime_error("the font is damaged: a table ends beyond the end of the file");
        }
    }
}

/// Gathers the contours of a glyph, in ems.
class OutlineGatherer {
public:
    explicit OutlineGatherer(double unit) : unit_(unit) {}

    void begin(glm::dvec2 at) {
        end();
        contours_.push_back({at});
        count(1);
    }
    void line(glm::dvec2 to) {
        const glm::dvec2 from = here();
        curve(from + (to - from) / 3.0, to - (to - from) / 3.0, to);
    }
    void quadratic(glm::dvec2 control, glm::dvec2 to) {
        const glm::dvec2 from = here();
        curve(from + (control - from) * (2.0 / 3), to + (control - to) * (2.0 / 3), to);
    }
    void curve(glm::dvec2 first, glm::dvec2 second, glm::dvec2 to) {
        count(3);
        if (contours_.empty()) contours_.push_back({glm::dvec2(0.0)});
        contours_.back().insert(contours_.back().end(), {first, second, to});
    }
    void end() {
        if (!contours_.empty() && here() != contours_.back().front()) line(contours_.back().front());
        if (!contours_.empty() && contours_.back().size() < 4) contours_.pop_back();
    }
    glm::dvec2 scaled(float x, float y) const { return glm::dvec2(x, y) * unit_; }

    /// HarfBuzz is written in C: failures are noted, not thrown.
    std::vector<GlyphContour> take() {
        end();
        if (points_ > most_glyph_points) {
            throw std::runtime_error("a glyph of the font has more than 100,000 points");
        }
        for (const GlyphContour& contour : contours_) {
            if (!std::all_of(contour.begin(), contour.end(), is_near)) refuse_damaged();
        }
        return std::move(contours_);
    }

private:
    static bool is_near(glm::dvec2 point) {
        constexpr double farthest = 1000;  // ems
        return std::fabs(point.x) < farthest && std::fabs(point.y) < farthest;
    }
    glm::dvec2 here() const { return contours_.empty() ? glm::dvec2(0.0) : contours_.back().back(); }
    void count(std::size_t more) {
        points_ += more;
        if (points_ > most_glyph_points) contours_.clear();
    }

    double unit_;
    std::size_t points_ = 0;
    std::vector<GlyphContour> contours_;
};

OutlineGatherer& gatherer(void* data) {
    return *static_cast<OutlineGatherer*>(data);
}

/// The functions that HarfBuzz calls for the parts of an outline.
DrawFunctions draw_functions() {
    DrawFunctions functions(hb_draw_funcs_create());
    hb_draw_funcs_set_move_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
            gatherer(data).begin(gatherer(data).scaled(x, y));
        },
        nullptr, nullptr);
    hb_draw_funcs_set_line_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
            gatherer(data).line(gatherer(data).scaled(x, y));
        },
        nullptr, nullptr);
    hb_draw_funcs_set_quadratic_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
            gatherer(data).quadratic(gatherer(data).scaled(cx, cy), gatherer(data).scaled(x, y));
        },
        nullptr, nullptr);
    hb_draw_funcs_set_cubic_to_func(
        functions.get(),
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float ax, float ay, float bx, float by, float x, float y,
           void*) {
            const OutlineGatherer& to = gatherer(data);
            gatherer(data).curve(to.scaled(ax, ay), to.scaled(bx, by), to.scaled(x, y));
        },
        nullptr, nullptr);
    hb_draw_funcs_make_immutable(functions.get());
    return functions;
}

constexpr hb_tag_t outline_tables[] = {HB_TAG('g', 'l', 'y', 'f'), HB_TAG('C', 'F', 'F', ' '),
                                       HB_TAG('C', 'F', 'F', '2')};

/// True if a font has outlines: not only bitmaps.
bool has_outlines(hb_face_t* face) {
    return std::any_of(std::begin(outline_tables), std::end(outline_tables), [&](hb_tag_t table) {
        return hb_blob_get_length(Blob(hb_face_reference_table(face, table)).get()) > 0;
    });
}

/// A name in the font, in English.
std::string name_in(hb_face_t* face, hb_ot_name_id_t id) {
    std::array<char, 200> text{};
    unsigned size = text.size();
    hb_ot_name_get_utf8(face, id, hb_language_from_string("en", -1), &size, text.data());
    return text.data();
}

class HarfBuzzFont final : public Font {
public:
    HarfBuzzFont(std::string bytes, const FoundFont& found) : bytes_(std::move(bytes)), name_(found.name) {
        const Blob blob(hb_blob_create(bytes_.data(), static_cast<unsigned>(bytes_.size()), HB_MEMORY_MODE_READONLY,
                                       nullptr, nullptr));
        // The upper half numbers the named instance of a variable font.
        const unsigned index = static_cast<unsigned>(found.index) & 0xFFFF;
        const unsigned instance = static_cast<unsigned>(found.index) >> 16;
        const Face face(hb_face_create(blob.get(), index));
        if (hb_face_get_glyph_count(face.get()) == 0)
            throw std::runtime_error("not a font; expected an OpenType font");
        require_whole(bytes_, index);
        if (!has_outlines(face.get())) throw std::runtime_error("the font has no outlines, only bitmaps");
        unit_ = 1.0 / hb_face_get_upem(face.get());
        font_.reset(hb_font_create(face.get()));
        if (instance > 0) hb_font_set_var_named_instance(font_.get(), instance - 1);
        set_variations(found.variations);
        hb_font_make_immutable(font_.get());
        if (name_.empty()) name_ = own_name(face.get());
        capital_height_ = measured_capital();
    }

    const std::string& name() const override { return name_; }
    double capital_height() const override { return capital_height_; }

    ShapedText shape(std::u32string_view line) const override {
        if (line.size() > most_font_letters) {
            throw std::runtime_error("a line of text is too long; expected at most 10,000 characters");
        }
        const std::vector<hb_codepoint_t> codes(line.begin(), line.end());
        ShapedText text;
        hb_position_t end = 0;
        for (const TextRun& run : runs_of(codes)) add_run(codes, run, end, text);
        text.width = end * unit_;
        return text;
    }

    std::vector<GlyphContour> outline(std::uint32_t glyph) const override {
        static const DrawFunctions functions = draw_functions();
        OutlineGatherer outline(unit_);
        {
            const std::scoped_lock lock(reading_);
#if HB_VERSION_ATLEAST(7, 0, 0)
            hb_font_draw_glyph(font_.get(), glyph, functions.get(), &outline);
#else
            hb_font_get_glyph_shape(font_.get(), glyph, functions.get(), &outline);
#endif
        }
        return outline.take();
    }

private:
    static std::string own_name(hb_face_t* face) {
        const std::string family = name_in(face, HB_OT_NAME_ID_FONT_FAMILY);
        const std::string style = name_in(face, HB_OT_NAME_ID_FONT_SUBFAMILY);
        return family + (family.empty() || style.empty() ? "" : " ") + style;
    }

    void set_variations(const std::string& list) {
        std::vector<hb_variation_t> variations;
        for (std::size_t begin = 0; begin < list.size();) {
            const std::size_t end = std::min(list.find(',', begin), list.size());
            hb_variation_t variation{};
            if (hb_variation_from_string(list.data() + begin, static_cast<int>(end - begin), &variation)) {
                variations.push_back(variation);
            }
            begin = end + 1;
        }
        if (variations.empty()) return;
        hb_font_set_variations(font_.get(), variations.data(), static_cast<unsigned>(variations.size()));
    }

    /// The height of an H, else the one that the font states.
    double measured_capital() const {
        constexpr double usual = 0.7, least = 0.1, most = 3;
        hb_codepoint_t glyph = 0;
        hb_glyph_extents_t extents{};
        hb_position_t stated = 0;
        double height = 0;
        if (hb_font_get_nominal_glyph(font_.get(), 'H', &glyph) &&
            hb_font_get_glyph_extents(font_.get(), glyph, &extents)) {
            height = extents.y_bearing * unit_;
        }
        if (!(height >= least) && hb_ot_metrics_get_position(font_.get(), HB_OT_METRICS_TAG_CAP_HEIGHT, &stated)) {
            height = stated * unit_;
        }
        return height >= least && height <= most ? height : usual;
    }

    /// @param end  where the text ends, in units of the font
    void add_run(std::span<const hb_codepoint_t> codes, const TextRun& run, hb_position_t& end,
                 ShapedText& text) const {
        const Buffer buffer(hb_buffer_create());
        hb_buffer_add_codepoints(buffer.get(), codes.data(), static_cast<int>(codes.size()),
                                 static_cast<unsigned>(run.begin), static_cast<int>(run.count));
        hb_buffer_set_direction(buffer.get(), run.is_leftward ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
        hb_buffer_set_script(buffer.get(), run.script);
        // Not the language of the environment, which would change the glyphs.
        hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));
        {
            const std::scoped_lock lock(reading_);
            hb_shape(font_.get(), buffer.get(), nullptr, 0);
        }
        if (!hb_buffer_allocation_successful(buffer.get())) refuse_damaged();
        unsigned count = 0;
        const hb_glyph_info_t* const glyphs = hb_buffer_get_glyph_infos(buffer.get(), &count);
        const hb_glyph_position_t* const places = hb_buffer_get_glyph_positions(buffer.get(), &count);
        for (unsigned i = 0; i < count; ++i) {
            text.glyphs.push_back(
                {glyphs[i].codepoint,
                 glm::dvec2(static_cast<double>(end) + places[i].x_offset, places[i].y_offset) * unit_,
                 places[i].x_advance * unit_, glyphs[i].cluster});
            end = moved(end, places[i].x_advance);
        }
    }

    static hb_position_t moved(hb_position_t at, hb_position_t by) {
        constexpr std::int64_t most = 1 << 30;
        const std::int64_t to = std::int64_t{at} + by;
        if (to > most || to < -most) refuse_damaged();
        return static_cast<hb_position_t>(to);
    }

    std::string bytes_;
    std::string name_;
    double unit_ = 1;  ///< a unit of the font in ems
    double capital_height_ = 0;
    Typeface font_;
    mutable std::mutex reading_;
};

}  // namespace

std::shared_ptr<const Font> make_font(std::string bytes, const FoundFont& found) {
    return std::make_shared<const HarfBuzzFont>(std::move(bytes), found);
}

}  // namespace sikku
