"""Floor 7: the exercises of the notebooks, their checks, and the copies for students."""

from priorlab.course.check import answer_key as answer_key
from priorlab.course.check import ask as ask
from priorlab.course.check import check as check
