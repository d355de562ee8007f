// SPDX-License-Identifier: BSD-3-Clause
// Scores of search results: those of Sphinx, but what explains stands before records, and these before the API reference.
const RECORDS = ["CHANGELOG", "docs/architecture", "docs/measured"];
var Scorer = {
  score: ([page, , , , score]) => score - (page.startsWith("api/") ? 200 : RECORDS.includes(page) ? 100 : 0),
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
