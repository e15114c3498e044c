// art/product/growth_print.cpp: several derivation lengths, in an animation or in a file each, and tiles that divide.
#include "art/motion/division.h"
#include "art/motion/division_file.h"
#include "art/motion/growth.h"
#include "art/motion/motion_cost.h"
#include "art/product/print_work.h"
#include "art/writer/print_cost.h"
#include "engine/derivation/forecast.h"

#include <tuple>

namespace sikku {
namespace {

class GrowthPrint : public PrintWork {
public:
    using PrintWork::PrintWork;

    Cost forecast() const override {
        if (is_relief(settings(), format())) return solid_cost(shorten(grammar()), print(), drawing(), format());
        return growth_cost(shorten(grammar()), print(), drawing(), growth_options());
    }

private:
    GrowthOptions growth_options() const {
        GrowthOptions growth;
        std::tie(growth.first, growth.last) = *settings().time.generations;
        growth.seconds = settings().time.frame_time.value_or(growth.seconds);
        growth.hold = settings().time.hold.value_or(growth.hold);
        growth.fits_each = settings().time.fit_frames;
        growth.is_animation = format() == PrintFormat::gif;
        return growth;
    }

    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        GrowthOptions growth = growth_options();
        const DrawReport drawn = draw_growth(grammar(), print(), options, growth, name, destination);
        report_text(drawn, name, made);
        if (drawn.overflows) {
            made.warn("the largest generation is larger than the page within its margins and is cut off");
        }
    }
};

class DivisionPrint : public PrintWork {
public:
    explicit DivisionPrint(PrintRequest request) : PrintWork(std::move(request)) {
        require_plain("tiles that divide are not drawn by hand; set hand to 0");
        require_straight("tiles that divide have straight edges; set line to straight");
    }

    Cost forecast() const override {
        return division_cost(shorten(grammar()), print(), drawing(), division_options());
    }

private:
    DivisionOptions division_options() const {
        DivisionOptions division;
        std::tie(division.first, division.last) =
            settings().time.generations.value_or(std::pair(std::int64_t{0}, grammar().steps()));
        division.is_gif = format() == PrintFormat::gif;
        division.times.division = *settings().time.division;
        division.times.rest = settings().time.frame_time.value_or(division.times.rest);
        division.times.hold = settings().time.hold.value_or(division.times.hold);
        return division;
    }

    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        try {
            report_overflow(draw_division(grammar(), print(), options, division_options(), name, destination), made);
        } catch (const DivisionError& error) {
            refuse_option("divide", "", error.what());
        }
    }
};

}  // namespace

std::unique_ptr<PrintWork> plan_growth(PrintRequest request) {
    return std::make_unique<GrowthPrint>(std::move(request));
}

std::unique_ptr<PrintWork> plan_division(PrintRequest request) {
    return std::make_unique<DivisionPrint>(std::move(request));
}

}  // namespace sikku
