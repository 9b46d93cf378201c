"""For whoever writes a day: a skeleton that passes, its worksheet, and its checks.

skeleton    the files of a new day, and of a new week
templates/  their texts; $number, $name, $title, $week and so on are filled in
sheet       a worksheet's skeleton, from the day's manifest
"""
