#include "output/stroke_font.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/units.h"

namespace tenku {
namespace {

// A glyph: its advance and the path of the pen, on a grid of 20 units to the em, y up from the
// baseline. M move, L line, C cubic Bezier curve, O ellipse (centre, radii, from and to angle in
// degrees, counter-clockwise positive) as a stroke of its own, A the same going on, D dot.
struct Glyph {
  double advance;
  const char* path;
};

constexpr double kUnitsPerEm = 20.0;
constexpr double kSpacing = 0.4;  // units, after every glyph

// clang-format off
constexpr Glyph kAscii[95] = {
    {5.6, ""},                                                                         // space
    {5, "M2.5 14L2.5 4.6D2.5 .7"},                                                     // !
    {7, "M2.1 14L2.1 10M4.9 14L4.9 10"},                                               // "
    {12, "M4.6 13L3 1M9.4 13L7.8 1M1.8 9L11 9M1.4 5L10.6 5"},                          // #
    {11.5, "M9.6 11.4C9 12.8 7.4 13.5 5.7 13.5C3.4 13.5 1.9 12.2 1.9 10.4C1.9 8.2 4 7.6 5.8 7.1"
           "C7.8 6.6 9.9 5.9 9.9 3.6C9.9 1.7 8.1 .5 5.7 .5C3.6 .5 1.9 1.4 1.4 3.2M5.7 15.6L5.7 -1.6"},  // $
    {15.4, "O4 10.6 2.6 3.4 0 360O11.4 3.4 2.6 3.4 0 360M11.8 14L3.6 0"},              // %
    {13.4, "M11.8 0L4 9.4C2.4 11.4 3 14.1 5.7 14.1C8.6 14.1 9 11 6.9 9.4L4 7.3"
           "C.4 4.7 1 -.1 5 -.1C8.4 -.1 10.6 2.6 11.2 6.6"},                           // &
    {4, "M2 14L2 10"},                                                                 // '
    {6, "M4.6 15.4C1.1 11 1.1 1.6 4.6 -2.8"},                                          // (
    {6, "M1.4 15.4C4.9 11 4.9 1.6 1.4 -2.8"},                                          // )
    {8, "M4 13.6L4 7.6M1.4 12.1L6.6 9.1M6.6 12.1L1.4 9.1"},                            // *
    {11, "M5.5 2.6L5.5 11M1.3 6.8L9.7 6.8"},                                           // +
    {4.6, "M2.5 .7L1.3 -2.6"},                                                         // ,
    {7, "M1.4 5.2L5.6 5.2"},                                                           // -
    {4.6, "D2.3 .7"},                                                                  // .
    {7.5, "M6.6 15L.9 -2"},                                                            // /
    {11, "O5.5 7 4 7.1 0 360"},                                                        // 0
    {11, "M2.4 11.2L6 14L6 0"},                                                        // 1
    {11, "M1.7 10.5C1.9 12.8 3.5 14.1 5.5 14.1C7.7 14.1 9.2 12.6 9.2 10.5C9.2 8.6 8 7.2 6.2 5.2L1.5 0L9.7 0"},  // 2
    {11, "M1.8 11.4C2.3 13.2 3.7 14.1 5.3 14.1C7.5 14.1 8.9 12.8 8.9 10.8C8.9 8.7 7.4 7.5 5 7.5L4.2 7.5"
         "M5 7.5C7.8 7.5 9.4 6.1 9.4 3.8C9.4 1.4 7.7 -.1 5.3 -.1C3.3 -.1 1.8 .9 1.3 2.8"},  // 3
    {11, "M7.5 0L7.5 14L1.2 3.9L10 3.9"},                                              // 4
    {11, "M8.9 14L2.8 14L2.2 7.6C3 8.5 4.1 9 5.4 9C7.8 9 9.5 7.2 9.5 4.5C9.5 1.7 7.8 -.1 5.3 -.1"
         "C3.3 -.1 1.9 .9 1.3 2.6"},                                                   // 5
    {11, "M8.9 12C8.3 13.4 7.2 14.1 5.9 14.1C3 14.1 1.5 11.4 1.5 6.6L1.5 4.5A5.5 4.5 4 4.6 180 -180"},  // 6
    {11, "M1.4 14L9.5 14L4.2 0"},                                                      // 7
    {11, "O5.5 10.7 3.4 3.4 0 360O5.5 3.6 4 3.7 0 360"},                               // 8
    {11, "M2.1 2C2.7 .6 3.8 -.1 5.1 -.1C8 -.1 9.5 2.6 9.5 7.4L9.5 9.5A5.5 9.5 4 4.6 0 -360"},  // 9
    {4.8, "D2.4 .7D2.4 8.8"},                                                          // :
    {4.8, "M2.6 .7L1.4 -2.6D2.5 8.8"},                                                 // ;
    {11, "M9.4 11L1.8 6.8L9.4 2.6"},                                                   // <
    {11, "M1.4 8.8L9.6 8.8M1.4 4.8L9.6 4.8"},                                          // =
    {11, "M1.6 11L9.2 6.8L1.6 2.6"},                                                   // >
    {9.6, "M1.5 11C1.9 13 3.2 14.1 4.9 14.1C6.9 14.1 8.2 12.8 8.2 10.9C8.2 8 4.8 7.8 4.8 4.4D4.8 .7"},  // ?
    {17, "O8.4 6 3 3.5 0 360M11.4 9.6L11.4 5C11.4 1.8 15.4 1.8 15.4 6.4A8.4 6.4 7 7.6 0 305"},  // @
    {13, "M1 0L6.5 14L12 0M2.9 4.8L10.1 4.8"},                                         // A
    {12.2, "M2 7.3L6.2 7.3A6.2 10.65 3.5 3.35 -90 90L2 14L2 0L6.6 0A6.6 3.65 3.9 3.65 -90 90"},  // B
    {13.2, "O7.4 7 5.9 7.1 42 318"},                                                   // C
    {13.8, "M2 0L2 14L5.8 14A5.8 7 6.2 7 90 -90L2 0"},                                 // D
    {11, "M9.6 14L2 14L2 0L9.8 0M2 7.3L8.6 7.3"},                                      // E
    {10.4, "M9.4 14L2 14L2 0M2 7L8.4 7"},                                              // F
    {14.2, "O7.4 7 5.9 7.1 42 318L12.5 3L12.5 6.7L8.4 6.7"},                           // G
    {13.6, "M2 0L2 14M11.6 0L11.6 14M2 7.3L11.6 7.3"},                                 // H
    {5, "M2.5 0L2.5 14"},                                                              // I
    {9, "M7 14L7 3.9A4 3.9 3 4 0 -155"},                                               // J
    {12, "M2 0L2 14M10.8 14L2 5.4M4.9 8.2L11.3 0"},                                    // K
    {10, "M2 14L2 0L9.4 0"},                                                           // L
    {16, "M2 0L2 14L8 3.5L14 14L14 0"},                                                // M
    {13.6, "M2 0L2 14L11.6 0L11.6 14"},                                                // N
    {14.8, "O7.4 7 5.9 7.1 0 360"},                                                    // O
    {11.6, "M2 0L2 14L6.2 14A6.2 10.2 4 3.8 90 -90L2 6.4"},                            // P
    {14.8, "O7.4 7 5.9 7.1 0 360M8.8 3.6L13 -1.2"},                                    // Q
    {12.2, "M2 0L2 14L6.2 14A6.2 10.3 3.9 3.7 90 -90L2 6.6M6.4 6.6L10.8 0"},           // R
    {11.5, "M9.6 11.5C9 13.3 7.4 14.1 5.7 14.1C3.4 14.1 1.9 12.7 1.9 10.7C1.9 8.3 4 7.7 5.8 7.2"
           "C7.8 6.7 9.9 6 9.9 3.5C9.9 1.3 8.1 -.1 5.7 -.1C3.6 -.1 1.9 .9 1.4 2.9"},   // S
    {12, "M1 14L11 14M6 14L6 0"},                                                      // T
    {13.6, "M2 14L2 4.8A6.8 4.8 4.8 4.9 180 360L11.6 14"},                             // U
    {12.6, "M1 14L6.3 0L11.6 14"},                                                     // V
    {18, "M1 14L5 0L9 13.4L13 0L17 14"},                                               // W
    {12, "M1.4 14L10.6 0M10.6 14L1.4 0"},                                              // X
    {12, "M1 14L6 6.8L11 14M6 6.8L6 0"},                                               // Y
    {12, "M1.6 14L10.4 14L1.5 0L10.6 0"},                                              // Z
    {6, "M4.8 15.4L1.8 15.4L1.8 -2.8L4.8 -2.8"},                                       // [
    {7.5, "M.9 15L6.6 -2"},                                                            // backslash
    {6, "M1.2 15.4L4.2 15.4L4.2 -2.8L1.2 -2.8"},                                       // ]
    {9, "M1.4 8.6L4.5 14L7.6 8.6"},                                                    // ^
    {10, "M0 -2.4L10 -2.4"},                                                           // _
    {5, "M1.4 14.6L3.6 11.8"},                                                         // `
    {10.6, "M2 8C2.6 9.4 3.8 10.1 5.2 10.1C7.4 10.1 8.7 8.9 8.7 6.9L8.7 0"
           "M8.7 5.9L6.4 5.9C3.2 5.9 1.5 4.9 1.5 2.8C1.5 1 2.9 -.1 4.6 -.1C6.6 -.1 8.1 1.2 8.7 2.8"},  // a
    {11, "M1.9 14L1.9 0O5.9 5 4 5.1 0 360"},                                           // b
    {9.7, "O5.7 5 4.1 5.1 46 314"},                                                    // c
    {11, "O5.1 5 4 5.1 0 360M9.1 14L9.1 0"},                                           // d
    {10.7, "M1.5 5.1L9.3 5.1A5.4 5.05 3.95 5.1 0 318"},                                // e
    {6.6, "M6.4 13.8C4.2 14.5 2.9 13.4 2.9 11.2L2.9 0M.8 9.6L5.9 9.6"},                // f
    {11, "O5.1 5 4 5.1 0 360M9.1 10L9.1 -.2C9.1 -2.9 7.4 -4.2 5.1 -4.2C3.6 -4.2 2.4 -3.7 1.7 -2.6"},  // g
    {11, "M1.9 14L1.9 0M1.9 6C2.6 8.6 4 10.1 6 10.1C8.2 10.1 9.1 8.7 9.1 6.4L9.1 0"},  // h
    {4.2, "M2.1 10L2.1 0D2.1 13.4"},                                                   // i
    {4.4, "M2.4 10L2.4 -1.6C2.4 -3.4 1.4 -4.3 -.4 -4.1D2.4 13.4"},                     // j
    {9.8, "M1.9 14L1.9 0M8.6 10L1.9 3.7M4.3 6L9.1 0"},                                 // k
    {4.2, "M2.1 14L2.1 0"},                                                            // l
    {16.4, "M1.9 10L1.9 0M1.9 6C2.5 8.6 3.7 10.1 5.4 10.1C7.3 10.1 8.2 8.8 8.2 6.6L8.2 0"
           "M8.2 6C8.8 8.6 10 10.1 11.7 10.1C13.6 10.1 14.5 8.8 14.5 6.6L14.5 0"},     // m
    {11, "M1.9 10L1.9 0M1.9 6C2.6 8.6 4 10.1 6 10.1C8.2 10.1 9.1 8.7 9.1 6.4L9.1 0"},  // n
    {10.9, "O5.45 5 4 5.1 0 360"},                                                     // o
    {11, "M1.9 10L1.9 -4.2O5.9 5 4 5.1 0 360"},                                        // p
    {11, "O5.1 5 4 5.1 0 360M9.1 10L9.1 -4.2"},                                        // q
    {7, "M1.9 10L1.9 0M1.9 5.6C2.4 8.4 4 10.3 6.6 9.9"},                               // r
    {9.2, "M7.7 8.1C7.2 9.5 6 10.1 4.6 10.1C2.9 10.1 1.8 9.2 1.8 7.7C1.8 5.9 3.2 5.5 4.7 5.1"
          "C6.3 4.7 7.9 4.2 7.9 2.5C7.9 .9 6.4 -.1 4.6 -.1C2.8 -.1 1.6 .6 1.1 2.1"},   // s
    {6.8, "M2.9 12.8L2.9 2.8C2.9 .6 4 -.4 6.2 .2M.8 9.6L5.9 9.6"},                     // t
    {11, "M1.9 10L1.9 3.6C1.9 1.3 2.8 -.1 5 -.1C7 -.1 8.4 1.4 9.1 4M9.1 10L9.1 0"},    // u
    {9.8, "M1 10L4.9 0L8.8 10"},                                                       // v
    {14.2, "M1 10L4.1 0L7.1 9.6L10.1 0L13.2 10"},                                      // w
    {9.4, "M1.1 10L8.3 0M8.3 10L1.1 0"},                                               // x
    {9.8, "M1 10L4.9 0M8.8 10L4.5 -1.2C3.8 -3.2 2.8 -4.4 .9 -4.1"},                    // y
    {9.2, "M1.4 10L7.8 10L1.2 0L8 0"},                                                 // z
    {7, "M5.4 15.4C2.6 15.4 3.4 12 3.4 9.6C3.4 7.4 2.6 6.4 1.2 6.3C2.6 6.2 3.4 5.2 3.4 3C3.4 .6 2.6 -2.8 5.4 -2.8"},  // {
    {4.8, "M2.4 15.4L2.4 -2.8"},                                                       // |
    {7, "M1.6 15.4C4.4 15.4 3.6 12 3.6 9.6C3.6 7.4 4.4 6.4 5.8 6.3C4.4 6.2 3.6 5.2 3.6 3C3.6 .6 4.4 -2.8 1.6 -2.8"},  // }
    {11, "M1.4 5.8C2.6 8.6 4.6 8 5.5 6.9C6.4 5.8 8.4 5 9.6 7.8"},                      // ~
};

const std::map<char32_t, Glyph>& signs() {
  static const std::map<char32_t, Glyph> kSigns{
      {U'°', {6.6, "O3.3 11.6 2.1 2.3 0 360"}},
      {U'±', {11, "M5.5 4L5.5 12M1.4 8L9.6 8M1.4 .6L9.6 .6"}},
      {U'×', {11, "M2.2 3.4L8.8 10M8.8 3.4L2.2 10"}},
      {U'·', {4.6, "D2.3 6.2"}},
      {U'²', {6.4, "M1 12.6C1.1 13.7 1.9 14.3 3 14.3C4.2 14.3 5 13.6 5 12.5C5 11.4 4.4 10.8 3.4 9.7L1 7.2L5.3 7.2"}},
      {U'³', {6.4, "M1.2 13.1C1.5 13.9 2.2 14.3 3 14.3C4.2 14.3 4.9 13.6 4.9 12.7C4.9 11.6 4 11 2.8 11"
                   "C4.3 11 5.2 10.3 5.2 9.1C5.2 7.9 4.3 7.1 3 7.1C2 7.1 1.2 7.6 .9 8.5"}},
      {U'µ', {11, "M1.9 10L1.9 -4.2M1.9 3.6C1.9 1.3 2.8 -.1 5 -.1C7 -.1 8.4 1.4 9.1 4M9.1 10L9.1 0"}},
      {U'–', {11, "M.8 5.2L10.2 5.2"}},
      {U'—', {17, "M.8 5.2L16.2 5.2"}},
      {U'−', {11, "M1.3 6.8L9.7 6.8"}},
      {U'‘', {4, "M1.5 10.6L2.6 14"}},
      {U'’', {4, "M2.6 14L1.5 10.6"}},
      {U'“', {7, "M1.5 10.6L2.6 14M4.3 10.6L5.4 14"}},
      {U'”', {7, "M2.6 14L1.5 10.6M5.4 14L4.3 10.6"}},
      {U'…', {14, "D2.3 .7D7 .7D11.7 .7"}},
      {U'ß', {11.4, "M1.9 0L1.9 10.2C1.9 12.7 3.2 14.1 5.3 14.1C7.4 14.1 8.6 12.9 8.6 11.2C8.6 9.4 7 8.7 5.6 7.9"
                    "C8.4 7.6 9.9 6.2 9.9 3.8C9.9 1.2 8 -.4 5.2 0"}},
      {U'ø', {10.9, "O5.45 5 4 5.1 0 360M9 10.6L1.9 -.6"}},
      {U'Ø', {14.8, "O7.4 7 5.9 7.1 0 360M12.2 14.8L2.6 -.8"}},
      {U'ı', {4.2, "M2.1 10L2.1 0"}},
  };
  return kSigns;
}

// Accents, for a letter whose top is at 10 and middle at 0.
constexpr const char* kGrave = "M-1.7 14.4L.9 11.9";
constexpr const char* kAcute = "M1.7 14.4L-.9 11.9";
constexpr const char* kCircumflex = "M-2.2 12L0 14.4L2.2 12";
constexpr const char* kTilde = "M-2.6 12.2C-1.4 14.4 -.6 13.6 0 13C.6 12.4 1.4 11.8 2.6 13.8";
constexpr const char* kDiaeresis = "D-1.9 13.2D1.9 13.2";
constexpr const char* kRing = "O0 13.4 1.6 1.6 0 360";
constexpr const char* kMacron = "M-2.4 12.9L2.4 12.9";
constexpr const char* kCaron = "M-2.2 14.4L0 12L2.2 14.4";
constexpr const char* kCedilla = "M.2 0C1.8 -1.4 1 -3.8 -1.4 -3.2";

struct Accented {
  char letter;
  const char* accent;
};

const std::map<char32_t, Accented>& accented_letters() {
  static const std::map<char32_t, Accented> kLetters{
      {U'À', {'A', kGrave}}, {U'Á', {'A', kAcute}}, {U'Â', {'A', kCircumflex}}, {U'Ã', {'A', kTilde}},
      {U'Ä', {'A', kDiaeresis}}, {U'Å', {'A', kRing}}, {U'Ç', {'C', kCedilla}}, {U'È', {'E', kGrave}},
      {U'É', {'E', kAcute}}, {U'Ê', {'E', kCircumflex}}, {U'Ë', {'E', kDiaeresis}}, {U'Ñ', {'N', kTilde}},
      {U'Ò', {'O', kGrave}}, {U'Ó', {'O', kAcute}}, {U'Ô', {'O', kCircumflex}}, {U'Õ', {'O', kTilde}},
      {U'Ö', {'O', kDiaeresis}}, {U'Ù', {'U', kGrave}}, {U'Ú', {'U', kAcute}}, {U'Û', {'U', kCircumflex}},
      {U'Ü', {'U', kDiaeresis}}, {U'à', {'a', kGrave}}, {U'á', {'a', kAcute}}, {U'â', {'a', kCircumflex}},
      {U'ã', {'a', kTilde}}, {U'ä', {'a', kDiaeresis}}, {U'å', {'a', kRing}}, {U'ç', {'c', kCedilla}},
      {U'è', {'e', kGrave}}, {U'é', {'e', kAcute}}, {U'ê', {'e', kCircumflex}}, {U'ë', {'e', kDiaeresis}},
      {U'í', {'i', kAcute}}, {U'ï', {'i', kDiaeresis}}, {U'î', {'i', kCircumflex}}, {U'ñ', {'n', kTilde}},
      {U'ò', {'o', kGrave}}, {U'ó', {'o', kAcute}}, {U'ô', {'o', kCircumflex}}, {U'õ', {'o', kTilde}},
      {U'ö', {'o', kDiaeresis}}, {U'ù', {'u', kGrave}}, {U'ú', {'u', kAcute}}, {U'û', {'u', kCircumflex}},
      {U'ü', {'u', kDiaeresis}}, {U'ā', {'a', kMacron}}, {U'ē', {'e', kMacron}}, {U'ī', {'i', kMacron}},
      {U'ō', {'o', kMacron}}, {U'ū', {'u', kMacron}}, {U'Ō', {'O', kMacron}}, {U'Š', {'S', kCaron}},
      {U'š', {'s', kCaron}}, {U'č', {'c', kCaron}}, {U'Č', {'C', kCaron}}, {U'ž', {'z', kCaron}},
      {U'Ž', {'Z', kCaron}}, {U'ř', {'r', kCaron}}, {U'ě', {'e', kCaron}},
  };
  return kLetters;
}
// clang-format on

constexpr Glyph kBox{12, "M1.6 0L1.6 14L10.4 14L10.4 0L1.6 0"};

// Walks along a path and lays down points.
class Pen {
 public:
  Pen(std::vector<PenStroke>& strokes, PixelPosition origin) : strokes_(strokes), origin_(origin) {}

  void draw(const char* path) {
    while (*path != '\0') {
      const char command = *path++;
      double v[6] = {};
      const int count = numbers_of(command);
      for (int i = 0; i < count; ++i) v[i] = next_number(path);
      step(command, v);
    }
  }

 private:
  static int numbers_of(char command) {
    return command == 'C' || command == 'O' || command == 'A' ? 6 : 2;
  }

  static double next_number(const char*& path) {
    while (*path == ' ') ++path;
    char* end = nullptr;
    const double value = std::strtod(path, &end);
    expects(end != path, "a glyph's path has all its numbers");
    path = end;
    return value;
  }

  void step(char command, const double (&v)[6]) {
    switch (command) {
      case 'M':
      case 'D':
        strokes_.emplace_back();
        return put(v[0], v[1]);
      case 'L':
        return put(v[0], v[1]);
      case 'C':
        return curve(v);
      case 'O':
        strokes_.emplace_back();
        return arc(v);
      case 'A':
        return arc(v);
      default:
        expects(false, "a glyph's path knows its commands");
    }
  }

  void put(double x, double y) {
    x_ = x;
    y_ = y;
    strokes_.back().points.push_back({origin_.x + x / kUnitsPerEm, origin_.y - y / kUnitsPerEm});
  }

  void curve(const double (&v)[6]) {
    constexpr int kSteps = 10;
    const double x0 = x_, y0 = y_;
    for (int i = 1; i <= kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps, u = 1.0 - t;
      const double a = u * u * u, b = 3.0 * u * u * t, c = 3.0 * u * t * t, d = t * t * t;
      put(a * x0 + b * v[0] + c * v[2] + d * v[4], a * y0 + b * v[1] + c * v[3] + d * v[5]);
    }
  }

  void arc(const double (&v)[6]) {
    const int steps = std::max(2, static_cast<int>(std::abs(v[5] - v[4]) / 10.0));
    for (int i = 0; i <= steps; ++i) {
      const double angle = (v[4] + (v[5] - v[4]) * i / steps) * kPi / 180.0;
      put(v[0] + v[2] * std::cos(angle), v[1] + v[3] * std::sin(angle));
    }
  }

  std::vector<PenStroke>& strokes_;
  PixelPosition origin_;
  double x_ = 0.0, y_ = 0.0;
};

// Next code point; a broken sequence counts as one unknown character a byte.
char32_t next_character(std::string_view& text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc0 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                                            : 4;
  char32_t code = length < 2 ? first : first & (0xffU >> (length + 1));
  bool sound = length > 0;
  for (std::size_t i = 1; i < length && sound; ++i) {
    sound = (byte(i) & 0xc0U) == 0x80U;
    code = code << 6U | (byte(i) & 0x3fU);
  }
  text.remove_prefix(sound ? length : 1);
  return sound ? code : 0xfffd;
}

void add_accented(PenText& text, const Accented& letter) {
  const bool is_small = letter.letter >= 'a';
  const char plain = letter.letter == 'i' ? '|' : letter.letter;  // an i under an accent has no dot
  const Glyph glyph = plain == '|' ? signs().at(U'ı') : kAscii[plain - ' '];
  Pen(text.strokes, {text.width, 0.0}).draw(glyph.path);
  const bool below = letter.accent == kCedilla;
  const PixelPosition middle{text.width + 0.5 * glyph.advance / kUnitsPerEm,
                             is_small || below ? 0.0 : -4.2 / kUnitsPerEm};
  Pen(text.strokes, middle).draw(letter.accent);
  text.width += (glyph.advance + kSpacing) / kUnitsPerEm;
}

}  // namespace

PenText pen_text(std::string_view text) {
  PenText pen;
  while (!text.empty()) {
    const char32_t code = next_character(text);
    const auto accented = accented_letters().find(code);
    if (accented != accented_letters().end()) {
      add_accented(pen, accented->second);
      continue;
    }
    const auto sign = signs().find(code == U'\u00a0' ? U' ' : code);
    const bool is_ascii = (code >= 32 && code <= 126) || code == U'\u00a0';
    const Glyph glyph = is_ascii                ? kAscii[code == U'\u00a0' ? 0 : code - 32]
                        : sign != signs().end() ? sign->second
                                                : kBox;
    Pen(pen.strokes, {pen.width, 0.0}).draw(glyph.path);
    pen.width += (glyph.advance + kSpacing) / kUnitsPerEm;
  }
  return pen;
}

}  // namespace tenku
