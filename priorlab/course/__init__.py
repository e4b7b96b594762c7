"""Floor 7: the exercises of the notebooks, their checks, and the copies for students."""

from priorlab.course.checking import answer_key as answer_key
from priorlab.course.checking import ask as ask
from priorlab.course.checking import check as check
