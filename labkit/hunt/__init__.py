"""Bug hunts: a right lab with one mistake of the catalogue put in, to be found.

    mistakes  the pool of mistakes that can be hunted, and the sample of a seed
    script    the hunted script: a lab, or a week's capstone, whose functions are closed
    hunted    what a closed function does when it is called
    capstone_list  the mistakes that a week's capstone shows, as a file;
              capstone_trials tries them and writes it
    case      a hunt as it stands: what was suspected, run and repaired
    experiment  a run or a call of the hunted script, and what it says
    tally     its row in the log, and what the rows add up to
    verdict   is it the function, and does the repair pass?

No file says what the mistake is: day, level and seed do, with this kit.
"""
