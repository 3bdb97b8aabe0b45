# SPDX-License-Identifier: GPL-2.0-or-later
# One run of a parameter table: yade-batch TABLE scripts/study/batch_run.py, or yade -n -x scripts/study/batch_run.py TABLE:LINE FOLDER.
import sys

from yade_timber.study.batch.run import main

main(sys.argv)
