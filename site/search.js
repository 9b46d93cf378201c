// What a search shows first. Sphinx's own script asks for `Scorer`; all but score is as it
// has it.
const FIRST = /^(commands|arm|index|README|w\d+-\w+\/docs\/)/; // what a student reads
const LAST = /^(CHANGELOG|CONTRIBUTING|labkit|tests|docs\/(architecture|authors|cluster))/;
var Scorer = {
  score: ([document, title, , , score]) => {
    const asked = new URLSearchParams(location.search).get("q")?.trim().toLowerCase();
    const exact = title.toLowerCase().split(" > ").at(-1) === asked ? 100 : 0;
    return score + exact + (FIRST.test(document) ? 10 : 0) - (LAST.test(document) ? 20 : 0);
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
