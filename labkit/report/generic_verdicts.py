"""Words for verdicts that describe the answers and do not name a mistake."""

UNNAMED = {
    "both-halves-off": "both halves are off",
    "both-off": "both results are off",
    "few-entries-off": "a few entries are off",
    "huge-numbers": "numbers that are far too large",
    "missing": "there is no such function",
    "none-or-not": "None where there is an answer, or the other way round",
    "not-accepted": "an answer that is not accepted",
    "not-an-array": "no array of numbers",
    "not-by-hand": "it calls what it was to write",
    "not-finite": "NaN or infinity",
    "not-numbers": "no numbers",
    "nothing-returned": "nothing is returned",
    "off": "wrong numbers, by no mistake that the kit knows",
    "one-line": "one change in a line makes it right",
    "part-off": "a part of it is off",
    "parts": "another number of results",
    "raises": "it stopped with an error",
    "refused": "it wanted what a task is not given",
    "shape": "an array of another shape",
    "some-inputs": "it stopped at some inputs",
    "stopped": "it did not return",
}


def in_words(slug: str) -> str:
    """Return these words, or a mistake's name without its hyphens."""
    if slug.startswith("slip-"):  # its sentence says which one
        return "one slip in the formula"
    return UNNAMED.get(slug, slug.replace("-", " "))
