#include "engine/io/vtk_xml.h"

#include <algorithm>

#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

constexpr const char* remedy = "export the file again as a VTK XML unstructured grid, uncompressed";

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  bool closes = false, is_empty = false;  ///< </name> and <name/>
  std::size_t begin = 0, end = 0;         ///< from '<' to behind '>'
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Goes from tag to tag; comments and <?...?> are skipped.
class Tags {
 public:
  explicit Tags(const FileBytes& file) : file_(file), text_(file.bytes) {}

  bool next(Tag& tag) {
    while (true) {
      at_ = text_.find('<', at_);
      if (at_ == std::string_view::npos) return false;
      if (text_.substr(at_, 4) == "<!--")
        at_ = find("-->", at_);
      else if (text_.substr(at_, 2) == "<?" || text_.substr(at_, 2) == "<!")
        at_ = find(">", at_);
      else
        break;
    }
    tag = Tag{};
    tag.begin = at_++;
    tag.closes = accept('/');
    tag.name = name();
    while (!accept_end(tag)) {
      const std::string key = name();
      if (!accept('=')) fail("expected '=' after the attribute " + in_quotes(key));
      tag.attributes[key] = value();
    }
    tag.end = at_;
    return true;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ >= text_.size()) fail("the file is truncated: it ends within a tag");
  }
  bool accept(char c) {
    skip_blanks();
    if (text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool accept_end(Tag& tag) {
    tag.is_empty = accept('/');
    if (accept('>')) return true;
    if (tag.is_empty) fail("expected '>' after '/'");
    return false;
  }
  std::string name() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) &&
           std::string_view("=/<>\"'").find(text_[at_]) == std::string_view::npos)
      ++at_;
    if (at_ == begin) fail("expected a name, found " + in_quotes(text_.substr(at_, 1)));
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string value() {
    skip_blanks();
    const char quote = text_[at_];
    if (quote != '"' && quote != '\'') fail("expected a value in quotes");
    const std::size_t begin = ++at_;
    at_ = find(std::string_view(&quote, 1), at_);
    return std::string(text_.substr(begin, at_ - 1 - begin));
  }
  /// Behind the next occurrence.
  std::size_t find(std::string_view what, std::size_t from) {
    const std::size_t found = text_.find(what, from);
    if (found == std::string_view::npos) fail("the file is truncated: it ends within a tag");
    return found + what.size();
  }
  [[noreturn]] void fail(const std::string& what) const {
    Place place = place_in(file_.name);
    const std::size_t at = std::min(at_, text_.size());
    place.line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw InputError(what, std::move(place), remedy);
  }

  const FileBytes& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

void find_appended_data(const FileBytes& file, const Tag& tag, VtkFile& outline) {
  const auto encoding = tag.attributes.find("encoding");
  outline.appended_encoding = encoding == tag.attributes.end() ? "base64" : encoding->second;
  const std::size_t underscore = file.bytes.find('_', tag.end);
  outline.appended_begin = underscore == std::string::npos ? file.bytes.size() : underscore + 1;
  outline.appended_end = file.bytes.rfind("</AppendedData");
  if (outline.appended_end == std::string::npos || outline.appended_end < outline.appended_begin)
    fail_at_byte(file, file.bytes.size(), "the file is truncated: its appended data have no end", remedy);
}

void check_header(const FileBytes& file, const VtkFile& outline) {
  const auto type = outline.header.find("type");
  if (type == outline.header.end() || type->second != "UnstructuredGrid")
    fail_at_byte(file, 0, "this is no VTK XML unstructured grid", remedy);
  if (outline.header.contains("compressor"))
    fail_at_byte(file, 0, "its data are compressed, which is not supported", remedy);
}

}  // namespace

const VtkArray* VtkFile::find(std::string_view parent, std::string_view name) const {
  for (const VtkArray& array : arrays)
    if (array.parent == parent && (name.empty() || array.attribute("Name") == name)) return &array;
  return nullptr;
}

VtkFile read_vtk_outline(const FileBytes& file) {
  VtkFile outline;
  Tags tags(file);
  Tag tag;
  std::string parent;
  bool complete = false;
  VtkArray* open = nullptr;
  while (!complete && tags.next(tag)) {
    // An array's text ends with the next tag: its own end, or that of remarks which ParaView puts behind the numbers.
    if (open) open->end = tag.begin;
    open = nullptr;
    if (tag.closes) {
      complete = tag.name == "VTKFile";
    } else if (tag.name == "VTKFile") {
      outline.header = tag.attributes;
      check_header(file, outline);
    } else if (tag.name == "Piece") {
      if (!outline.piece.empty())
        fail_at_byte(file, tag.begin, "it has several pieces", "merge the pieces into one file");
      outline.piece = tag.attributes;
    } else if (tag.name == "DataArray") {
      outline.arrays.push_back({parent, tag.attributes, tag.end, tag.end});
      open = tag.is_empty ? nullptr : &outline.arrays.back();
    } else if (tag.name == "AppendedData") {
      find_appended_data(file, tag, outline);
      complete = true;  // what follows is data, which may look like tags
    } else if (tag.name.ends_with("Data") || tag.name == "Points" || tag.name == "Cells") {
      parent = tag.name;
    }
  }
  check_header(file, outline);
  if (!complete) fail_at_byte(file, file.bytes.size(), "the file is truncated: it has no </VTKFile>", remedy);
  if (outline.piece.empty()) fail_at_byte(file, 0, "it has no Piece", remedy);
  return outline;
}

}  // namespace ccdt::io
