"""The inspector: the arm, its frames, the student's own code, in a browser.

    make view DAY=2

The page belongs to no day. A day brings tabs in `w1-foundations/dayN/inspector.py`:

    from labkit.inspector.ghost import Ghost
    from labkit.inspector.page import Page
    from labkit.inspector.tab import Tab

    GHOST = Ghost("fk_space", FRAMES, ask)    # the function that draws the ghost arm

    class Screws(Tab):
        title = "Screws"

        def __init__(self, page: Page) -> None:    # the tab was opened
            super().__init__(page)
            self.axes = page.draw.lines(ends, "purple")
            self.scale = page.slider("length", 0, 1, 0.5, self.changed, unit="m")
            page.buttons(["let go"], self.let_go)

        def on_move(self, q: Array) -> None:       # the arm is at q; also at the start
            self.axes.points = ...                 # and when the file was saved

        def begin(self) -> None:                   # opened, or saved: play it
            self.loop.start(PLAYS)

        def lost(self) -> None:                    # a function gave no answer: nothing
            self.axes.visible = False              # of the file before may stay

        def close(self) -> None:                   # left; whatever `page` made is gone
            ...

    TABS = [Screws]

The first of TABS is open at the start; Joints, Chain and Tasks, which every day has,
follow where they are not in it. Both names are optional. `GHOST.questions(model, q)`
returns the arguments for each frame in `GHOST.frames`, such as
`fk_space(screws[:k], M_k, q[:k])`. Where there is no GHOST, no ghost arm is drawn; the
file is watched all the same.

What a tab has in `page` (`labkit/inspector/page.py` says the arguments):

    model, arm, q, pose(name)   the robot, its numbers, the configuration, MuJoCo's pose
    move(q)                     moves the arm, in every browser
    own(library, units=...)     the student's functions, in the sandbox; a line says how
                                they compare with the library's of the same names
    job(work, done)             work that waits for them, on another thread
    animate(step, hz, work)     a loop in real time: start(), stop(), toggle()
    draw                        arrows, lines, curve, sphere, ellipsoid, frame, label,
                                ghost (a second arm), robot (a scene of MuJoCo's),
                                target (a pose to drag)
    slider, buttons, choice, tick    viser's own, each with a callback
    html, say, matrix, legend   text, a line, a pose, what the colours mean
    bars, plot                  numbers per joint against limits; curves over time
    image                       what a camera sees, in colours or in depths
    light(chosen, shown)        which frames are drawn, and which one stands out
    hide_arm()                  no arm but the tab's own
    gui, scene                  viser's own, for what is missing here

Everything a tab makes vanishes when the tab is left: its widgets, its drawings, its
loops. Make everything anew in `__init__`; keep on the class what should outlive the
tab. At a save all that was said turns grey until the new file has answered. What a
tab shows and a task of the day computes is asked of `own`: the table is in
`tests/test_inspector_tabs.py`, which changes a sign in each. What is wanted at one
moment needs two queues (`page.jobs_apart()`): of those that wait in `job` the newest is
done.

Callbacks run one after the other on the server's event loop: keep them under 20 ms
and never wait in one. `wide = True` on the class hides the two matrices at the top,
`camera` says from where one looks.

The modules, from the numbers to the page:

    arm, ghost                  MuJoCo's poses and the library's; the student's
    student, own                the student's files in the checker's sandbox
    words, typed                numbers as HTML; as people type them, in the URL
    shapes, meshes, draw, scene what is in the picture
    page, instruments, animate  what a tab gets
    robot                       a tab's own robot, instead of the arm
    tab, common_tabs            what a tab is; the tabs that every day has
    app                         the page as a whole
    plain                       its numbers and sliders for a browser without 3D
    guard                       who may talk to it; our part of viser's page
    serve, recording            listens until Ctrl-C; a film without a server

`arm`, `ghost`, `words` and `typed` need nothing new, the rest viser (the extra `view`).
"""
