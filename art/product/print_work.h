// art/product/print_work.h: planned products of a document: prints, models, reliefs, animations, lessons.
#pragma once

#include "art/print/print.h"
#include "art/product/draw_settings.h"
#include "art/product/unused_options.h"
#include "art/writer/draw_options.h"
#include "engine/interpreter.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// A request for a product.
struct PrintRequest {
    Document document;
    PrintFormat format;
    DrawSettings settings;
    GivenOptions given;
    std::filesystem::path folder{};  ///< of files that options name
};

/// A planned product. Each derived class makes one kind.
class PrintWork : public Work {
public:
    /// @throws SettingError, PatternError
    explicit PrintWork(PrintRequest request);

    std::vector<std::pair<std::string, std::string>> read_files() const override { return files_; }
    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override;
    /// Number of threads for pictures; 0: one for each core.
    int threads() const { return drawing_.threads; }
    /// Passes the pixels to `receive` instead of writing them. @throws SettingError if there are several pictures
    void pass_pixels(std::function<void(Rendering& rendering, const PixelSize& size)> receive);

protected:
    const Document& document() const { return document_; }
    const Grammar& grammar() const { return lit_ ? *lit_ : document_.grammar(); }
    PrintFormat format() const { return format_; }
    const DrawSettings& settings() const { return settings_; }
    const Print& print() const { return print_; }
    const DrawOptions& drawing() const { return drawing_; }
    const std::filesystem::path& folder() const { return folder_; }
    /// Throws SettingError at the key `hand` or `line` if lines are drawn by hand, or splines.
    void require_plain(const std::string& message) const;
    void require_straight(const std::string& message) const;
    /// Throws SettingError at the first key of fields, weaves, parallel lines or tiles that is set.
    void refuse_line_work(const char* subject) const;

    /// Makes the outputs and adds remarks.
    virtual void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                              Made& made) = 0;
    /// Report of the drawing, for remarks about options without an effect.
    DrawReport report{};

private:
    /// The reason if the drawing is that of the axiom; see reason_of_no_steps().
    std::string no_steps() const {
        return settings_.time.generations || settings_.time.shows_rule ? "" : reason_of_no_steps(document_);
    }
    void plan_drawing();
    void place_swatch(const Swatch& swatch);
    void drop_border();
    void drop_floor();
    void check_drawing() const;
    void refuse_key(const char* name, const std::string& message) const;
    void light_up(const Monitor& monitor, Made& made);

    Document document_;
    PrintFormat format_;
    DrawSettings settings_;
    GivenOptions given_;
    Print print_;
    DrawOptions drawing_;
    std::vector<std::string> dropped_;                        ///< warnings of a border or floor that is left out
    std::vector<std::pair<std::string, std::string>> files_;  ///< of borders and surfaces
    std::filesystem::path folder_;
    std::optional<Grammar> lit_;  ///< drawn instead of the document's, if a step is lit
};

/// Products, by the settings and the format.
std::unique_ptr<PrintWork> plan_model(PrintRequest request);
std::unique_ptr<PrintWork> plan_division(PrintRequest request);
std::unique_ptr<PrintWork> plan_growth(PrintRequest request);
std::unique_ptr<PrintWork> plan_lesson(PrintRequest request);
std::unique_ptr<PrintWork> plan_row(PrintRequest request);
std::unique_ptr<PrintWork> plan_rule(PrintRequest request);
std::unique_ptr<PrintWork> plan_one(PrintRequest request);

/// Warns if the text of the pattern is too long for the format.
void report_text(const DrawReport& report, const std::filesystem::path& name, Made& made);
/// Warns of an animation that is larger than its page.
void report_overflow(const DrawReport& report, Made& made);

}  // namespace sikku
