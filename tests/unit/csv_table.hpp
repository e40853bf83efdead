// Reads the tables of expected values in tests/data/: '#' lines are skipped, the first other line is the header, fields
// may stand in double quotes. Throws std::runtime_error with file and line for what is not there or no number.
#pragma once

#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dioptre {

struct CsvTable {
    std::string file;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;

    std::size_t size() const { return rows.size(); }

    std::size_t column(std::string_view name) const {
        for (std::size_t i = 0; i < header.size(); ++i)
            if (header[i] == name) return i;
        throw std::runtime_error(file + ": no column '" + std::string(name) + "'");
    }

    const std::string& text(std::size_t row, std::string_view name) const { return rows.at(row).at(column(name)); }

    /// "inf", "-inf" and "nan" included.
    double number(std::size_t row, std::string_view name) const {
        const std::string& field = text(row, name);
        double value = 0.0;
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
        if (error != std::errc() || end != field.data() + field.size())
            throw std::runtime_error(file + ": row " + std::to_string(row) + ", column '" + std::string(name) + "': '" +
                                     field + "' is no number");
        return value;
    }

    /// For a failing case to print.
    std::string describe(std::size_t row) const {
        std::string line;
        for (std::size_t i = 0; i < header.size(); ++i) line += header[i] + "=" + rows[row][i] + " ";
        return line;
    }
};

inline std::vector<std::string> splitCsvLine(std::string_view line) {
    std::vector<std::string> fields(1);
    bool inQuotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool doubled = inQuotes && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
        if (doubled) {
            fields.back() += '"';
            ++i;
        } else if (line[i] == '"') {
            inQuotes = !inQuotes;
        } else if (line[i] == ',' && !inQuotes) {
            fields.emplace_back();
        } else {
            fields.back() += line[i];
        }
    }
    return fields;
}

inline CsvTable readCsvTable(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    CsvTable table;
    table.file = file.string();
    std::string line;
    while (std::getline(stream, line)) {
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty() || line.front() == '#') continue;
        auto fields = splitCsvLine(line);
        if (table.header.empty()) {
            table.header = std::move(fields);
            continue;
        }
        if (fields.size() != table.header.size())
            throw std::runtime_error(table.file + ": '" + line + "' has another number of columns than the header");
        table.rows.push_back(std::move(fields));
    }
    if (table.rows.empty()) throw std::runtime_error(table.file + ": holds no rows");
    return table;
}

/// Of each line of a text, which may break lines within quotes; the last line ends, too.
inline std::vector<std::size_t> cellsPerLine(std::string_view csv) {
    std::vector<std::size_t> cells{1};
    bool quoted = false;
    for (const char c : csv) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) ++cells.back();
        if (c == '\n' && !quoted) cells.push_back(1);
    }
    cells.pop_back();
    return cells;
}

#ifdef DIOPTRE_TEST_DATA
/// By name in tests/data/, e.g. "pupil.csv".
inline CsvTable testTable(std::string_view name) {
    return readCsvTable(std::filesystem::path(DIOPTRE_TEST_DATA) / name);
}
#endif

}  // namespace dioptre
