#include "art/vector/pdf.h"

#include "art/print/tile_kinds.h"
#include "art/vector/operator_writer.h"
#include "art/vector/pdf_text.h"
#include "art/vector/pdf_x.h"
#include "engine/base/deflate.h"
#include "engine/base/hash.h"

#include <zlib.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double mark_width = 0.25;     // points
constexpr double most_units = 14400.0;  // maximum side of a page, in its units: ISO 32000-1, annex C

constexpr std::size_t pack_bytes = std::size_t{1} << 16;
/// Readers keep a whole path in memory.
constexpr int most_pdf_points = 8192;

/// Compresses pieces of streams separately, so that one compressor serves any number of streams at once.
class Deflater {
public:
    Deflater() {
        if (deflateInit2(&stream_, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
            throw std::runtime_error("zlib: out of memory");
        }
    }
    ~Deflater() { deflateEnd(&stream_); }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;

    /// Appends a whole number of bytes of blocks, none of them the last.
    void append(std::string_view text, std::string& packed) {
        deflateReset(&stream_);
        stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(text.data()));
        stream_.avail_in = static_cast<uInt>(text.size());
        do {
            const std::size_t size = packed.size();
            packed.resize(size + pack_bytes);
            stream_.next_out = reinterpret_cast<Bytef*>(packed.data() + size);
            stream_.avail_out = static_cast<uInt>(pack_bytes);
            deflate(&stream_, Z_FULL_FLUSH);
            packed.resize(packed.size() - stream_.avail_out);
        } while (stream_.avail_out == 0);
    }

private:
    z_stream stream_{};
};

struct PdfLayer : OperatorLayer {
    std::string label;
    int stream = 0;            ///< number of the object with the drawing
    int length = 0;            ///< number of the object with its length, unless known in advance
    int group = 0;             ///< number of the optional content group
    Colour colour;             ///< colour of strokes or discs
    bool translucent = false;  ///< the whole layer is painted as one
    std::string packed;
    std::uint64_t packed_bytes = 0;  ///< including those in the file
    uLong checksum = 1;              ///< Adler-32
};

/// Appends an empty last block, and the checksum.
void end_packed(PdfLayer& layer) {
    layer.packed += std::string_view("\x03\x00", 2);
    for (const int shift : {24, 16, 8, 0}) layer.packed += static_cast<char>(layer.checksum >> shift & 0xFF);
    layer.packed_bytes += 6;
}

class PdfWriter final : public OperatorWriter<PdfLayer, PagesWriter> {
public:
    PdfWriter(const Print& print, Output& file)
        : OperatorWriter(print, file, most_pdf_points),
          colours_(print.press),
          size_(print.page),
          edge_(press_edge(print.press)) {
        const double longest =
            (std::max(print.page.width, print.page.height) + 2 * edge_) * 1000.0 * points_of_micrometre;
        unit_ = std::max(1.0, std::ceil(longest / most_units));
        write("%PDF-1.6\n%\xE2\xE3\xCF\xD3\n");
        catalog_ = new_object();
        pages_ = new_object();
        page_ = new_object();
        resources_ = new_object();
    }

    void begin_part(const Print& part, const Window& window) override {
        end_part();
        take_part(part, window);
    }

    void begin_page(const Print& page, const Window& shown, glm::dvec2 at, double scale) override {
        end_part();
        if (is_shared_) {
            end_page();
            page_ = new_object();
        } else {
            shared_ = std::exchange(contents_, {});
        }
        is_shared_ = true;
        page_print_ = page;
        size_ = page.page;
        const Window target{at.x, at.y, scale * shown.width, scale * shown.height, true};
        const double height = print_.page.height;
        paint(write_plain_stream(
            fmt::format("q {} W n {} 0 0 {} {} {} cm\n", rectangle(target, 0.0), decimal(scale, 14),
                        decimal(scale, 14), user(edge_ + at.x - scale * (shown.left + edge_)),
                        user(edge_ + size_.height - at.y - scale * (edge_ + height - shown.top)))));
        contents_ += shared_;
        paint(write_plain_stream("Q\n"));
        take_part(page_print_, {0.0, 0.0, size_.width, size_.height, false});
    }

    void finish() override {
        end_part();
        write_marks();
        end_page();
        write_structure();
    }

private:
    /// Completes the objects of the layers, and notes where they are painted.
    void end_part() {
        for (auto& [order, layer] : layers_) {
            end_path(layer);
            if (order.first == LayerKind::polygons) show_kind(layer, no_kind);
            layer.text.append(layer.translucent ? "Q\n" : "Q\nEMC\n");
        }
        // An object that is under way in the file ends before the next begins.
        for (auto& [order, layer] : layers_) {
            if (!layer.to_file) continue;
            pack(layer);
            end_packed(layer);
            write(layer.packed);
            write("\nendstream\nendobj\n");
            write_object(layer.length, fmt::format("{}", layer.packed_bytes));
        }
        std::string groups, order_of_groups;
        if (part_ == &print_) begin_art();
        const std::string area = rectangle(window_, part_ == &print_ ? print_.press.bleed : 0.0);
        if (window_.clips) paint(write_plain_stream(fmt::format("q {} W n\n", area)));
        if (const auto& ground = part_->style.ground; ground && ground->alpha > 0) {
            const int group = new_object();
            order_of_groups = groups = write_group(group, "ground");
            paint(write_plain_stream(fmt::format("/OC /G{} BDC q {} {} {} f Q EMC\n", group,
                                                 ink(*ground, false, false), set_alpha(ground->alpha), area)));
        }
        for (auto& [order, layer] : layers_) {
            if (!layer.to_file) {
                pack(layer);
                end_packed(layer);
                begin_object(layer.stream);
                write(stream_head(layer, fmt::format("{}", layer.packed_bytes)));
                write(layer.packed);
                write("\nendstream\nendobj\n");
            }
            const std::string reference = write_group(layer.group, layer.label);
            groups += reference;
            order_of_groups += reference;
            if (order.first == LayerKind::polygons && !kind_groups_.empty()) {
                const std::string kinds = write_kinds();
                groups += kinds;
                order_of_groups += " [" + kinds + " ]";
            }
            int content = layer.stream;
            if (layer.translucent) {
                fmt::format_to(std::back_inserter(forms_), "/X{} {} 0 R\n", layer.stream, layer.stream);
                content = write_plain_stream(fmt::format("/OC /G{} BDC q {} /X{} Do Q EMC\n", layer.group,
                                                         set_alpha(layer.colour.alpha), layer.stream));
            }
            paint(content);
            layer.packed = {};
        }
        if (window_.clips) paint(write_plain_stream("Q\n"));
        groups_ += groups;
        if (part_ == &print_) {
            order_ += order_of_groups;
        } else if (!groups.empty()) {
            order_ += fmt::format(" [ {}{} ]", text_string(part_->title), order_of_groups);
        }
        layers_.clear();
    }

    // --- groups of tiles, within that of all fills: the tiles of a kind, wherever they are painted ---

    static constexpr std::size_t no_kind = ~std::size_t{0};

    /// Assigns the following content to a kind of tiles, or to none.
    void show_kind(PdfLayer& layer, std::size_t kind) {
        if (kind == kind_) return;
        if (kind_ != no_kind) layer.text.append("EMC\n");
        kind_ = kind;
        if (kind == no_kind) return;
        if (kind == kind_groups_.size()) kind_groups_.push_back(new_object());
        layer.text.append(fmt::format("/OC /G{} BDC\n", kind_groups_[kind]));
    }
    /// Writes the groups of this part; returns the references to them.
    std::string write_kinds() {
        std::string references;
        for (std::size_t i = 0; i < kind_groups_.size(); ++i) {
            references += write_group(kind_groups_[i], kinds_.kinds()[i].label());
        }
        kind_groups_.clear();
        kinds_ = {};
        return references;
    }

    /// Completes the page. Its object is written with the others at the end.
    void end_page() {
        entries_.push_back({page_,
                            fmt::format("/MediaBox {}\n/CropBox {}\n/BleedBox {}\n/TrimBox {}\n", box(edge_),
                                        box(edge_), box(print_.press.bleed), box(0.0)),
                            std::exchange(contents_, {})});
        page_ = 0;
    }

    /// Clips the drawing at the bleed, so that it does not run into the marks.
    void begin_art() {
        if (!has_marks()) return;
        const Window sheet{0.0, 0.0, print_.page.width, print_.page.height, true};
        paint(write_plain_stream(fmt::format("q {} W n\n", rectangle(sheet, print_.press.bleed))));
    }

    bool has_marks() const { return print_.press.marks || print_.press.registration; }

    /// Writes the marks in all inks, so that every plate shows them.
    void write_marks() {
        if (!has_marks()) return;
        std::string text = fmt::format("{} w", decimal(mark_width / unit_, 4));
        const auto line = [&](glm::dvec2 from, glm::dvec2 to) {
            fmt::format_to(std::back_inserter(text), " {} {} m {} {} l", user_x(from.x), user_y(from.y), user_x(to.x),
                           user_y(to.y));
        };
        if (print_.press.marks) {
            for (const CropMark& mark : crop_marks(print_.page, print_.press)) line(mark.from, mark.to);
        }
        if (print_.press.registration) {
            for (const glm::dvec2 centre : registration_marks(print_.page, print_.press)) {
                line(centre - glm::dvec2(registration_arm, 0), centre + glm::dvec2(registration_arm, 0));
                line(centre - glm::dvec2(0, registration_arm), centre + glm::dvec2(0, registration_arm));
                const auto at = [&](double x, double y) {
                    const glm::dvec2 point = centre + registration_radius * glm::dvec2(x, y);
                    return user_x(point.x) + " " + user_y(point.y);
                };
                constexpr double k = quarter_circle;
                fmt::format_to(std::back_inserter(text), " {} m {} {} {} c {} {} {} c {} {} {} c {} {} {} c h",
                               at(1, 0), at(1, k), at(k, 1), at(0, 1), at(-k, 1), at(-1, k), at(-1, 0), at(-1, -k),
                               at(-k, -1), at(0, -1), at(k, -1), at(1, -k), at(1, 0));
            }
        }
        const int group = new_object();
        const std::string reference = write_group(group, "marks");
        groups_ += reference;
        order_ += reference;
        paint(write_plain_stream(fmt::format("Q /OC /G{} BDC q /Registration CS 1 SCN {} S Q EMC\n", group, text)));
    }

    void paint(int stream) { fmt::format_to(std::back_inserter(contents_), " {} 0 R", stream); }
    void write(std::string_view text) {
        if (print_.press.inks) {
            for (std::size_t at = 0; at < text.size(); at += std::size_t{1} << 30) {
                const std::string_view part = text.substr(at, std::size_t{1} << 30);
                content_ =
                    crc32(content_, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(part.size()));
            }
        }
        file_.write(text);
    }

    int new_object() {
        offsets_.push_back(0);
        return static_cast<int>(offsets_.size());
    }
    void begin_object(int number) {
        offsets_[static_cast<std::size_t>(number) - 1] = file_.size();
        write(fmt::format("{} 0 obj\n", number));
    }
    void write_object(int number, std::string_view contents) {
        begin_object(number);
        write(contents);
        write("\nendobj\n");
    }
    int write_object(std::string_view contents) {
        const int number = new_object();
        write_object(number, contents);
        return number;
    }

    /// Converts millimetres to units of the page.
    std::string user(double millimetres) const {
        return decimal(millimetres * 1000.0 * points_of_micrometre / unit_, 4);
    }
    /// Coordinates of a point in millimetres from the top left corner of the trimmed sheet, y down.
    std::string user_x(double x) const { return user(edge_ + x); }
    std::string user_y(double y) const { return user(edge_ + size_.height - y); }

    std::string rectangle(const Window& window, double around) const {
        return fmt::format("{} {} {} {} re", user_x(window.left - around),
                           user_y(window.top + window.height + around), user(window.width + 2 * around),
                           user(window.height + 2 * around));
    }
    /// Formats the lower left and the upper right corner.
    std::string box(double around) const {
        return fmt::format("[{} {} {} {}]", user_x(-around), user_y(size_.height + around),
                           user_x(size_.width + around), user_y(-around));
    }

    /// The operators that set the colour of lines or of areas; records the spot colours that it names.
    /// @param is_drawn  true for lines and dots, false for areas
    std::string ink(Colour colour, bool of_lines, bool is_drawn) {
        const std::vector<Spot>& spots = print_.press.spots;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            const Colour& spot = spots[i].colour;
            if (spot.red != colour.red || spot.green != colour.green || spot.blue != colour.blue) continue;
            spots_.insert(i);
            return fmt::format("{}/S{} {}", overprint(true, Overprint::spots), i, of_lines ? "CS 1 SCN" : "cs 1 scn");
        }
        const bool is_black = is_black_ink(print_.press, colour, is_drawn);
        return fmt::format("{}{}{}", overprint(is_black, Overprint::black), colours_.channels(colour, is_drawn),
                           colours_.set(of_lines));
    }

    /// The operator that sets overprinting for the following content; empty if nothing in the document overprints.
    std::string overprint(bool may, Overprint kind) const {
        const Overprint chosen = print_.press.overprint;
        if (chosen == Overprint::none) return "";
        return may && (chosen == kind || chosen == Overprint::all) ? "/Over gs " : "/Under gs ";
    }

    /// A tint of 0 is white; devices without the ink mix it from others.
    void write_colour_spaces() {
        if (spots_.empty() && !has_marks()) return;
        const auto separation = [](const std::string& name, std::string_view space, std::string_view none,
                                   std::string_view full) {
            return fmt::format("[/Separation {} /{} << /FunctionType 2 /Domain [0 1] /C0 [{}] /C1 [{}] /N 1 >>]\n",
                               name, space, none, full);
        };
        write("/ColorSpace <<\n");
        for (const std::size_t i : spots_) {
            const Spot& spot = print_.press.spots[i];
            write(fmt::format("/S{} {}", i,
                              separation(name_object(spot.name), colours_.space(), colours_.none(),
                                         colours_.channels(spot.colour, false))));
        }
        if (has_marks()) write("/Registration " + separation("/All", "DeviceGray", "1", "0"));
        write(">>\n");
    }

    /// The operator that sets the opacity of fills and groups; records the state that it names.
    std::string set_alpha(std::uint8_t alpha) {
        if (alpha == 255 && alphas_.empty()) return "";
        alphas_.insert(alpha);
        return fmt::format("/A{} gs", alpha);
    }

    /// Maps micrometres with y down to units of the page with y up.
    std::string matrix() const {
        const std::string scale = decimal(points_of_micrometre / unit_, 14);
        return fmt::format("{} 0 0 -{} {} {} cm", scale, scale, user(edge_), user(edge_ + size_.height));
    }

    std::string stream_head(const PdfLayer& layer, const std::string& length) const {
        const std::string form =
            layer.translucent ? fmt::format(
                                    "/Type /XObject /Subtype /Form /BBox [0 0 {} {}] "
                                    "/Group << /S /Transparency /CS /{} >> {}",
                                    user(2 * edge_ + size_.width), user(2 * edge_ + size_.height), colours_.space(),
                                    print_.press.inks ? fmt::format("/Resources {} 0 R ", resources_) : "")
                              : "";
        return fmt::format("<< {}/Length {} /Filter /FlateDecode >>\nstream\n", form, length);
    }

    /// The first layer of all is written to the file at once, the others wait in memory. One whose `colour` is
    /// translucent is painted as a whole, so that nothing darkens where it overlaps or where paths are cut.
    void begin_layer(PdfLayer& layer, LayerOrder order, Colour colour) override {
        layer.label = label_of(order, colour);
        layer.colour = order.first == LayerKind::polygons ? Colour{} : colour;
        layer.translucent = layer.colour.alpha != 255;
        layer.stream = new_object();
        layer.group = new_object();
        layer.packed = "\x78\x9C";
        layer.packed_bytes = layer.packed.size();
        if (layers_.size() == 1) {
            layer.to_file = true;
            layer.length = new_object();
            begin_object(layer.stream);
            write(stream_head(layer, fmt::format("{} 0 R", layer.length)));
        }
        if (!layer.translucent) layer.text.append(fmt::format("/OC /G{} BDC\n", layer.group));
        layer.text.append(fmt::format("q {} 1 J 1 j\n", matrix()));
    }
    std::string ink_of(LayerKind kind, Colour colour) override {
        const std::string text = ink(colour, kind == LayerKind::strokes, kind != LayerKind::polygons);
        return kind == LayerKind::polygons ? text + " " + set_alpha(colour.alpha) : text;
    }
    void begin_polygon(PdfLayer& layer, std::span<const glm::dvec2> vertices, Colour colour) override {
        if (!print_.names_tiles) return;
        show_kind(layer, vertices.empty() ? no_kind : kinds_.kind_of(vertices, colour));
    }

    void flush(PdfLayer& layer) override {
        if (layer.text.size() >= flush_bytes) pack(layer);
    }
    /// Compresses the text of the layer.
    void pack(PdfLayer& layer) {
        const std::string_view text = layer.text.view();
        const std::size_t before = layer.packed.size();
        layer.checksum = adler32_z(layer.checksum, reinterpret_cast<const Bytef*>(text.data()), text.size());
        // A polygon's text may exceed the range of zlib's counters.
        for (std::size_t at = 0; at < text.size(); at += std::size_t{1} << 30) {
            deflater_.append(text.substr(at, std::size_t{1} << 30), layer.packed);
        }
        layer.packed_bytes += layer.packed.size() - before;
        layer.text.clear();
        if (layer.to_file) {
            write(layer.packed);
            layer.packed.clear();
        }
    }

    int write_plain_stream(const std::string& text) {
        return write_object(fmt::format("<< /Length {} >>\nstream\n{}endstream", text.size(), text));
    }

    /// Writes an optional content group; returns the reference to it.
    std::string write_group(int number, std::string_view label) {
        write_object(number, fmt::format("<< /Type /OCG /Name {} >>", text_string(label)));
        fmt::format_to(std::back_inserter(properties_), "/G{} {} 0 R\n", number, number);
        return fmt::format(" {} 0 R", number);
    }

    void write_structure() {
        begin_object(resources_);
        write("<<\n");
        if (!properties_.empty()) write(fmt::format("/Properties <<\n{}>>\n", properties_));
        write_colour_spaces();
        if (!forms_.empty()) write(fmt::format("/XObject <<\n{}>>\n", forms_));
        const bool overprints = print_.press.overprint != Overprint::none;
        if (!alphas_.empty() || overprints) {
            write("/ExtGState <<\n");
            if (overprints) {
                write(
                    "/Over << /Type /ExtGState /OP true /op true /OPM 1 >>\n"
                    "/Under << /Type /ExtGState /OP false /op false /OPM 0 >>\n");
            }
            for (const int alpha : alphas_) {
                const std::string value = decimal(alpha / 255.0, 4);
                write(fmt::format("/A{} << /Type /ExtGState /CA {} /ca {} >>\n", alpha, value, value));
            }
            write(">>\n");
        }
        write(">>\nendobj\n");

        // Plates are mixed as separate inks, which a page group in RGB would prevent.
        const bool has_group = !alphas_.empty() && spots_.empty() && !has_marks();
        std::string kids;
        for (const PageEntry& page : entries_) {
            write_object(
                page.object,
                fmt::format("<< /Type /Page /Parent {} 0 R\n{}{}{}/Resources {} 0 R\n/Contents [{} ] >>", pages_,
                            page.boxes, unit_ > 1.0 ? fmt::format("/UserUnit {}\n", decimal(unit_, 4)) : "",
                            has_group ? fmt::format("/Group << /S /Transparency /CS /{} >>\n", colours_.space()) : "",
                            resources_, page.contents));
            fmt::format_to(std::back_inserter(kids), "{}{} 0 R", kids.empty() ? "" : " ", page.object);
        }
        write_object(pages_, fmt::format("<< /Type /Pages /Kids [{}] /Count {} >>", kids, entries_.size()));
        const std::string title = print_.title.empty() && print_.press.inks ? "Sikku" : print_.title;
        const std::string id = print_.press.inks ? identifier() : "";
        const std::string press = print_.press.inks ? write_press(title, id) : "";
        begin_object(catalog_);
        write(fmt::format("<< /Type /Catalog /Pages {} 0 R\n{}", pages_, press));
        if (!groups_.empty()) {
            write(fmt::format("/OCProperties << /OCGs [{} ] /D << {}/Order [{} ] >> >>\n", groups_,
                              print_.press.inks ? "/Name (Layers) " : "", order_));
        }
        write(">>\nendobj\n");
        const int info = new_object();
        begin_object(info);
        write("<< ");
        if (!title.empty()) write(fmt::format("/Title {}\n", text_string(title)));
        if (print_.press.inks) write(pdf_x_information());
        if (!print_.made.empty()) write(fmt::format("/Subject {}\n", text_string(print_.made)));
        // An additional key, which the standard allows: the print can be made again from it.
        if (!print_.pattern.empty()) write(fmt::format("/SikkuPattern {}\n", text_string(print_.pattern)));
        write("/Creator (Sikku) >>\nendobj\n");

        const std::uint64_t table = file_.size();
        write(fmt::format("xref\n0 {}\n0000000000 65535 f \n", offsets_.size() + 1));
        for (const std::uint64_t offset : offsets_) write(fmt::format("{:010} 00000 n \n", offset));
        write(fmt::format("trailer\n<< /Size {} /Root {} 0 R /Info {} 0 R{} >>\nstartxref\n{}\n%%EOF\n",
                          offsets_.size() + 1, catalog_, info,
                          id.empty() ? "" : fmt::format(" /ID [<{}> <{}>]", id, id), table));
    }

    /// 32 hexadecimal digits that depend on everything written so far, and on the texts of the print.
    std::string identifier() const {
        TextHash hash;
        hash.add_piece(fmt::format("{} {}", content_, file_.size()));
        for (const std::string* text : {&print_.title, &print_.made, &print_.pattern}) hash.add_piece(*text);
        return hash.digits();
    }

    /// Writes the output intent and the metadata of PDF/X-4; returns their entries in the catalogue.
    std::string write_press(const std::string& title, const std::string& id) {
        const PressInks& inks = *print_.press.inks;
        const std::string packed =
            deflated({reinterpret_cast<const char*>(inks.profile.data()), inks.profile.size()}, Deflate::zlib);
        const int profile =
            write_object(fmt::format("<< /N 4 /Length {} /Filter /FlateDecode >>\nstream\n", packed.size()) + packed +
                         "\nendstream");
        const int intent =
            write_object(fmt::format("<< /Type /OutputIntent /S /GTS_PDFX /OutputConditionIdentifier {} /Info {} "
                                     "/DestOutputProfile {} 0 R >>",
                                     text_string(inks.name), text_string(inks.name), profile));
        const std::string packet = pdf_x_metadata(title, id);
        const int metadata = write_object(fmt::format(
            "<< /Type /Metadata /Subtype /XML /Length {} >>\nstream\n{}endstream", packet.size(), packet));
        return fmt::format("/Metadata {} 0 R\n/OutputIntents [{} 0 R]\n", metadata, intent);
    }

    Deflater deflater_;
    PdfColours colours_;
    uLong content_ = 0;                   ///< CRC-32 of everything written, for the identifier
    std::vector<std::uint64_t> offsets_;  ///< offsets of the objects, from number 1
    std::set<int> alphas_;
    std::set<std::size_t> spots_;  ///< spot colours that were used
    std::string contents_;         ///< streams in the order in which they are painted
    std::string groups_;           ///< optional content groups
    std::string order_;            ///< groups as a reader lists them: those of a part together
    std::string properties_;       ///< groups as resources
    std::string forms_;
    TileKinds kinds_;               ///< kinds of tiles in the part being drawn
    std::vector<int> kind_groups_;  ///< numbers of their groups
    std::size_t kind_ = no_kind;    ///< kind being painted
    /// A completed page.
    struct PageEntry {
        int object;
        std::string boxes, contents;
    };
    std::vector<PageEntry> entries_;
    Page size_;               ///< size of the page that is being drawn
    Print page_print_;        ///< the print given to begin_page()
    std::string shared_;      ///< references to the streams of the drawing that all pages show
    bool is_shared_ = false;  ///< begin_page() was called
    const double edge_;       ///< millimetres from the edge of the medium to the trimmed sheet
    double unit_ = 1.0;       ///< points of one unit of the page
    int catalog_ = 0;
    int pages_ = 0;
    int page_ = 0;  ///< number of the page that is being drawn
    int resources_ = 0;
};

}  // namespace

std::unique_ptr<PrintWriter> write_pdf(const Print& print, Output& file) {
    return std::make_unique<PdfWriter>(print, file);
}

std::unique_ptr<PagesWriter> write_pdf_pages(const Print& print, Output& file) {
    return std::make_unique<PdfWriter>(print, file);
}

}  // namespace sikku
