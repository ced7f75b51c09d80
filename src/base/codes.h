// SPDX-License-Identifier: MIT
// Diagnostic codes 1..99: files (1..19), YAML (20..39), values (40..59), JSON (60..79), more
// about files (80..89).
// Test: every code is provoked by a test in tests/base.
#pragma once

#include "base/diagnostics.h"

namespace rigc::codes {

// Files.
inline constexpr Code kCannotRead{1, Severity::error, "file cannot be read",
                                  "The file does not exist or the system refused to open it. Check "
                                  "the path and its permissions."};
inline constexpr Code kNotRegularFile{2, Severity::error, "not a regular file",
                                      "Only regular files are read and replaced; the path is a "
                                      "folder, a device, a socket or a FIFO."};
inline constexpr Code kFileTooLarge{
    3, Severity::error, "file is too large",
    "The file is larger than rigc reads for this purpose. It is probably not the file you meant."};
inline constexpr Code kCannotWrite{
    4, Severity::error, "file cannot be written",
    "The system refused to create, write, flush or rename the file. A file that was there before "
    "is "
    "unchanged. Check the folder, its permissions and the space on the disk."};
inline constexpr Code kNoSuchFolder{5, Severity::error, "folder does not exist",
                                    "The folder that should hold the output is missing. rigc makes "
                                    "no folders by itself; create it."};
inline constexpr Code kWriteProtected{
    6, Severity::error, "file is write-protected",
    "The file to be replaced is read-only. Make it writable, or choose another output."};
inline constexpr Code kFileLocked{
    7, Severity::error, "file is in use by another rigc",
    "Another rigc process holds the lock of this file. Wait until it is done, then try again."};
inline constexpr Code kHardLink{
    8, Severity::warning, "file has other hard links",
    "Replacing a file gives its name to new content; other hard links keep the old content."};

// YAML.
inline constexpr Code kYamlSyntax{
    20, Severity::error, "YAML syntax",
    "The text is not well-formed YAML. Look at the marked place and the line above it."};
inline constexpr Code kYamlTooLarge{
    21, Severity::error, "YAML file is too large",
    "A YAML file has at most 4 MB and 1,000,000 values. Split it, or move data out of it."};
inline constexpr Code kYamlBadUtf8{
    22, Severity::error, "YAML file is not UTF-8",
    "The file contains bytes that are not UTF-8 text. Save it as UTF-8."};
inline constexpr Code kYamlControlCharacter{
    23, Severity::error, "control character in YAML",
    "YAML text has no control characters but tab and line ends. Inside double quotes write an "
    "escape such as \\x1b."};
inline constexpr Code kYamlDocuments{
    24, Severity::error, "several YAML documents",
    "A file holds one document. Remove the `---` and what follows, or make it a file of its own."};
inline constexpr Code kYamlDuplicateKey{
    25, Severity::error, "duplicate key",
    "A key occurs twice in one map; one of its values would be lost. Remove or rename one."};
inline constexpr Code kYamlBadKey{
    26, Severity::error, "key is not text",
    "The keys of a map are plain words; lists, maps and null cannot be keys."};
inline constexpr Code kYamlTag{
    27, Severity::error, "YAML tag",
    "YAML type tags such as !!int are not used here: a value's type follows from its key."};
inline constexpr Code kYamlAliasCycle{
    28, Severity::error, "alias inside its own anchor",
    "An alias stands inside the value that its anchor names, which would make it endless."};
inline constexpr Code kYamlAliasExplosion{29, Severity::error, "aliases expand to too much",
                                          "Aliases stand for copies; together they would make more "
                                          "than 200,000 values or 16 MB of text."};
inline constexpr Code kYamlTooDeep{30, Severity::error, "YAML is nested too deeply",
                                   "Lists and maps are nested at most 100 deep, aliases included."};
inline constexpr Code kYamlBadMerge{
    31, Severity::error, "value of << is not a map",
    "A merge key takes a map, or a list of maps, usually as aliases: `<<: *base`."};
inline constexpr Code kYamlUnknownAnchor{
    32, Severity::error, "alias without an anchor",
    "The alias names an anchor that is not defined above it. Anchors are written &name."};

// Values.
inline constexpr Code kNotANumber{
    40, Severity::error, "not a number",
    "A finite decimal number is needed here, such as 0.5 or -2e3, without quotes or units."};
inline constexpr Code kNotAnInteger{
    41, Severity::error, "not an integer",
    "A whole number is needed here, without point, exponent or quotes."};
inline constexpr Code kNotABoolean{42, Severity::error, "not a boolean",
                                   "Booleans are true and false, or on and off, unquoted."};
inline constexpr Code kNotText{43, Severity::error, "not text",
                               "Text is needed here, not a list, a map or nothing."};
inline constexpr Code kNotAName{
    44, Severity::error, "not a name",
    "Names have letters, digits, `_` and `-`, do not start with a digit or `-`, and have at most "
    "255 characters."};
inline constexpr Code kNotASequence{
    45, Severity::error, "not a list",
    "A list is needed here: `[a, b]`, or lines that start with `-`."};
inline constexpr Code kNotAMap{46, Severity::error, "not a map",
                               "A map is needed here: `{key: value}`, or `key: value` lines."};
inline constexpr Code kWrongCount{47, Severity::error, "wrong number of values",
                                  "The list has more or fewer values than are needed here."};
inline constexpr Code kUnknownKey{
    48, Severity::error, "unknown key",
    "This map has no such key. It may be misspelt or belong to another place."};

// JSON.
inline constexpr Code kJsonSyntax{60, Severity::error, "JSON syntax",
                                  "The text is not JSON as RFC 8259 defines it."};
inline constexpr Code kJsonTooLarge{
    61, Severity::error, "JSON is too large",
    "A JSON text has at most 256 MiB and 1,048,576 values, and 3 more in each 32 bytes."};
inline constexpr Code kJsonBadUtf8{62, Severity::error, "JSON is not UTF-8",
                                   "JSON strings are UTF-8; this one has other bytes."};
inline constexpr Code kJsonBadString{63, Severity::error, "bad JSON string",
                                     "Strings have no control characters, only the escapes of RFC "
                                     "8259, and no half surrogate pairs."};
inline constexpr Code kJsonDuplicateKey{
    64, Severity::error, "duplicate key in JSON",
    "A key occurs twice in one object. Programs disagree which one counts, so rigc takes neither."};
inline constexpr Code kJsonTooDeep{65, Severity::error, "JSON is nested too deeply",
                                   "Arrays and objects are nested at most 512 deep."};
inline constexpr Code kJsonNumberRange{
    66, Severity::error, "JSON number out of range",
    "The number is too large for a double and would read as infinite."};
inline constexpr Code kJsonTrailing{
    67, Severity::error, "bytes after the JSON value",
    "A JSON text is one value, followed by nothing but white space."};

// More about files.
inline constexpr Code kFileChanged{
    80, Severity::error, "file changed while it was read",
    "Another program wrote to the file while rigc was reading or copying it, so the result would "
    "have been a mixture. Nothing was written; run rigc again."};

inline constexpr Code kUnknownChoice{81, Severity::error, "unknown word",
                                     "Only a few words may stand here; the hint lists them."};

inline constexpr Code kFileReplaced{
    82, Severity::error, "file changed since it was read",
    "Another program changed, replaced or removed the file after rigc had read it. Its work stays "
    "as it is and nothing was written; run rigc again."};
inline constexpr Code kBackupDiffers{
    83, Severity::error, "another backup is there",
    "A backup is never overwritten. Name another folder for the backups, or move the old ones."};

inline constexpr const Code* base_codes[] = {
    &kCannotRead,        &kNotRegularFile,     &kFileTooLarge,     &kCannotWrite,
    &kNoSuchFolder,      &kWriteProtected,     &kFileLocked,       &kHardLink,
    &kYamlSyntax,        &kYamlTooLarge,       &kYamlBadUtf8,      &kYamlControlCharacter,
    &kYamlDocuments,     &kYamlDuplicateKey,   &kYamlBadKey,       &kYamlTag,
    &kYamlAliasCycle,    &kYamlAliasExplosion, &kYamlTooDeep,      &kYamlBadMerge,
    &kYamlUnknownAnchor, &kNotANumber,         &kNotAnInteger,     &kNotABoolean,
    &kNotText,           &kNotAName,           &kNotASequence,     &kNotAMap,
    &kWrongCount,        &kUnknownKey,         &kJsonSyntax,       &kJsonTooLarge,
    &kJsonBadUtf8,       &kJsonBadString,      &kJsonDuplicateKey, &kJsonTooDeep,
    &kJsonNumberRange,   &kJsonTrailing,       &kFileChanged,      &kUnknownChoice,
    &kFileReplaced,      &kBackupDiffers};

/// Errors for which the exit status is 3: not the work but the file system is at fault.
constexpr bool is_file_system(const Code& code) {
  return code.severity == Severity::error && code.number != kFileTooLarge.number &&
         (code.number <= kFileLocked.number || code.number == kFileChanged.number ||
          code.number == kFileReplaced.number);
}

}  // namespace rigc::codes
