#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "io/atomic_file.h"
#include "report/document.h"
#include "report/sections.h"
#include "validation/case.h"

namespace meltpoint::report {

std::string make_validation(const Workplace& workplace, const validation::Case& one)
{
    log_info(fmt::format("{}: {}", one.name, one.about));
    const validation::Outcome outcome =
        one.run({.context = workplace.context, .quiet = workplace.quiet, .stop = workplace.stop});
    if (!outcome.holds()) {
        throw runtime_error("{} is out of its range on {}: see meltpoint validate {}", one.name,
                            workplace.context.info().name, one.name);
    }
    std::vector<Row> rows;
    for (const validation::Measurement& measurement : outcome.measurements) {
        rows.push_back({measurement.quantity, fmt::format("{:.3g}", measurement.value), measurement.range()});
    }
    std::string text = fmt::format("{}\n\n", one.about);
    for (const validation::Figure& figure : outcome.figures) {
        const std::string svg = plot::to_svg(figure.plot);
        write_file_atomically(workplace.folder / figure.file, std::as_bytes(std::span(svg)));
        text += fmt::format("![{}]({}{})\n\n", figure.plot.title, workplace.link, figure.file);
    }
    return text + table({"measured", "value", "range"}, rows) + fmt::format("\n`meltpoint validate {}`. ", one.name) +
           provenance(workplace);
}

} // namespace meltpoint::report
