"""Bug hunts: a right lab with one mistake of the catalogue put in, to be found.

    quarry    which mistakes can be hunted, and which one a seed draws
    script    the hunted script: a lab, or a week's capstone, whose functions are closed
    hunted    what a closed function does when it is called
    written   which mistakes a capstone shows; seen tries them
    case      a hunt as it stands: what was suspected, run and repaired
    experiment  a run or a call of the hunted script, and what it says
    tally     its row in the log, and what the rows add up to
    verdict   is it the function, and does the repair pass?

No file says what the mistake is: day, level and seed do, with this kit.
"""
